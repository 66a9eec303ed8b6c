/* What every test program includes: CMocka, which needs four standard headers before it, and how a case is defined. */
#ifndef JAM_TEST_H
#define JAM_TEST_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif
#include <cmocka.h>
void add_case(const char *name, CMUnitTestFunction run);
void add_fixture(CMFixtureFunction before, CMFixtureFunction after);
void add_arguments(int (*take)(int argc, char **argv));
#ifdef __cplusplus
}
/* libjam has a function of that name, so fail_msg must do without. */
#undef fail
#undef fail_msg
#define fail_msg(...) (print_error(__VA_ARGS__), print_error("\n"), _fail(__FILE__, __LINE__))
#endif

#define AT_START(name) __attribute__((constructor)) static void name(void)
/* A case, which cases.c runs: CASE(name) { ... } */
#define CASE(name)                                \
  static void name(void **its_state);             \
  AT_START(add_##name) { add_case(#name, name); } \
  static void name(__attribute__((unused)) void **its_state)
/* What is called before the first case and after the last one of a program. */
#define FIXTURE(before, after) \
  AT_START(add_its_fixture) { add_fixture(before, after); }
/* take(argc, argv): the exit status of a program that was called with words of its own, or -1. */
#define ARGUMENTS(take) \
  AT_START(add_its_arguments) { add_arguments(take); }

/* DEFAULTS(crunch, o): options with their defaults. SIZED(jam_info, info): a struct of zeros that the library may fill.
 */
#define DEFAULTS(kind, name) \
  jam_##kind##_options name; \
  assert_int_equal(jam_##kind##_options_init(&name, sizeof name), JAM_OK)
#define SIZED(type, name)        \
  type name;                     \
  memset(&name, 0, sizeof name); \
  name.struct_size = sizeof name
/* What a call returns, and a part of the text that it leaves. */
#define SAYS(call, status, words)                                                                          \
  do {                                                                                                     \
    assert_int_equal(call, status);                                                                        \
    if (!strstr(jam_last_error(), words)) fail_msg("'%s' does not contain '%s'", jam_last_error(), words); \
  } while (0)
#endif
