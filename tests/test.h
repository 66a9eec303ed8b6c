/* What every test program includes first: CMocka, which needs four standard headers before it. */
#ifndef JAM_TEST_H
#define JAM_TEST_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#include <cmocka.h>
#ifdef __cplusplus
}
/* libjam has a function of that name, so fail_msg must do without. */
#undef fail
#undef fail_msg
#define fail_msg(...) (print_error(__VA_ARGS__), print_error("\n"), _fail(__FILE__, __LINE__))
#endif
#endif
