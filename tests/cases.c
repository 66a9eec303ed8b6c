/* main of every C test: `capi_create` runs all its cases, `capi_create NAME` those whose names match (with * and ?),
   `capi_create --list` names them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "test.h"

static struct CMUnitTest cases[100];
static size_t count;
static CMFixtureFunction before_all, after_all;
static int (*own_arguments)(int argc, char **argv);

void add_case(const char *name, CMUnitTestFunction run) {
  if (count == sizeof cases / sizeof *cases) abort();
  cases[count].name = name;
  cases[count++].test_func = run;
}

void add_fixture(CMFixtureFunction before, CMFixtureFunction after) {
  before_all = before;
  after_all = after;
}

void add_arguments(int (*take)(int argc, char **argv)) { own_arguments = take; }

static int matches(const char *pattern, const char *name) {
  if (*pattern == '*') return matches(pattern + 1, name) || (*name && matches(pattern, name + 1));
  if (!*name) return !*pattern;
  return (*pattern == '?' || *pattern == *name) && matches(pattern + 1, name + 1);
}

int main(int argc, char **argv) {
  const int done = own_arguments ? own_arguments(argc, argv) : -1;
  size_t k, found = 0;
  if (done >= 0) return done;
  if (argc > 2) {
    fprintf(stderr, "usage: %s [NAME | --list]\n", argv[0]);
    return 2;
  }
  if (argc == 2 && !strcmp(argv[1], "--list")) {
    for (k = 0; k < count; ++k) printf("%s\n", cases[k].name);
    return 0;
  }
  if (argc == 2) {
    for (k = 0; k < count; ++k) found += (size_t)matches(argv[1], cases[k].name);
    if (!found) {
      fprintf(stderr, "no case matches %s; --list names the cases\n", argv[1]);
      return 2;
    }
    cmocka_set_test_filter(argv[1]);
  }
  return _cmocka_run_group_tests("tests", cases, count, before_all, after_all);
}
