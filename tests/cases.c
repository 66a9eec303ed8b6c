/* Linked into every C test: `capi_create` runs all its cases, `capi_create NAME` those whose names match (with * and
   ?), `capi_create --list` names them. The linker sends main and CMocka's runner here (--wrap), so no test repeats it.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

int __real_main(int argc, char **argv);
int __wrap_main(int argc, char **argv);
int __real__cmocka_run_group_tests(const char *group, const struct CMUnitTest *tests, size_t count,
                                   CMFixtureFunction setup, CMFixtureFunction teardown);
int __wrap__cmocka_run_group_tests(const char *group, const struct CMUnitTest *tests, size_t count,
                                   CMFixtureFunction setup, CMFixtureFunction teardown);

static const char *wanted;

static int matches(const char *pattern, const char *name) {
  if (*pattern == '*') return matches(pattern + 1, name) || (*name && matches(pattern, name + 1));
  if (!*name) return !*pattern;
  return (*pattern == '?' || *pattern == *name) && matches(pattern + 1, name + 1);
}

int __wrap__cmocka_run_group_tests(const char *group, const struct CMUnitTest *tests, size_t count,
                                   CMFixtureFunction setup, CMFixtureFunction teardown) {
  size_t k, found = 0;
  if (wanted && !strcmp(wanted, "--list")) {
    for (k = 0; k < count; ++k) printf("%s\n", tests[k].name);
    return 0;
  }
  for (k = 0; wanted && k < count; ++k) found += (size_t)matches(wanted, tests[k].name);
  if (wanted && !found) {
    fprintf(stderr, "no case matches %s; --list names the cases\n", wanted);
    return 2;
  }
  if (wanted) cmocka_set_test_filter(wanted);
  return __real__cmocka_run_group_tests(group, tests, count, setup, teardown);
}

int __wrap_main(int argc, char **argv) {
  if (argc > 2) {
    fprintf(stderr, "usage: %s [NAME | --list]\n", argv[0]);
    return 2;
  }
  if (argc == 2) wanted = argv[1];
  return __real_main(argc, argv);
}
