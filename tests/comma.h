/* A locale with a decimal comma. Where none is installed one is compiled into a folder, if Debian's package `locales`
 * is there. */
#ifndef JAM_TEST_COMMA_H
#define JAM_TEST_COMMA_H
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* The name of the locale that is set now, or NULL. */
static inline const char *set_comma_locale(const char *folder) {
  const char *names[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "nl_NL.UTF-8"};
  char command[256];
  size_t k;
  for (k = 0; k < 3; ++k)
    if (setlocale(LC_ALL, names[k])) return names[k];
  if (access("/usr/share/i18n/locales/de_DE", R_OK)) return NULL;
  snprintf(command, sizeof command, "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8 >%s/localedef.log 2>&1", folder,
           folder);
  if (system(command) != 0 || setenv("LOCPATH", folder, 1) != 0) return NULL;
  return setlocale(LC_ALL, "de_DE.UTF-8");
}

#endif
