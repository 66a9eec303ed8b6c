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
#undef fail /* libjam has a function of that name: fail_msg serves tests */
#endif
#endif
