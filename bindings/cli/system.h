/* What jam-pack asks of the system: system_posix.c, system_windows.c. Names of files are UTF-8. What fails returns -1
 * or NULL, with errno. */
#ifndef JAM_PACK_SYSTEM_H
#define JAM_PACK_SYSTEM_H
#include <stddef.h>
#include <stdio.h>

typedef enum file_kind { KIND_NONE, KIND_FILE, KIND_FOLDER, KIND_OTHER } file_kind; /* other: a pipe, a device */
file_kind kind_of(const char *path);
int may_write(const char *path);  /* to a file that is there: 0 or -1 */
int may_create(const char *path); /* a file in the folder of this name: 0 or -1 */
/* The name that a file has, or would have: without `.` and `..`, and where the system can, without links. NULL when its
 * folder is not there. The caller frees it. */
char *resolve(const char *path);
FILE *open_stream(const char *path, const char *mode); /* fopen */
int open_in_place(const char *path);                   /* a descriptor to write to a pipe or a device */
/* A write to a pipe without a reader, or beyond the limit on the size of files, then fails, and no signal ends the
 * program. With 0 those who had the signals get them back. */
void ignore_signals_of_writes(int yes);

/* Closed ones of the three standard descriptors lead nowhere from now on: no file that is opened becomes one of them,
 * and what is printed there fails. */
void keep_standard_descriptors(void);

/* A stream that collects a text. *text, which the caller frees, and *size are there when close_text has returned 0. */
FILE *open_text(char **text, size_t *size);
int close_text(FILE *file, char **text, size_t *size);

/* A file that appears whole or not at all: written under a short name of its own in the folder of the target, then
 * renamed. A killed program leaves at most this file, in the moment in which it is written. */
int replace_file(const char *path, const char *text, size_t size);

/* Ctrl-C and a request to end call `handler`, and a write beyond the limit on the size of files fails, until
 * give_signals_back(). */
void take_signals(void (*handler)(int number));
void give_signals_back(void);

/* The words of the command line in UTF-8: those of main, or in their place new ones. */
void take_words(int *argc, char ***argv);
/* Runs a line of the shell; 0 where it ended well. Ctrl-C that ends the line ends this program too. */
int run_shell(const char *line);
/* Runs a program in place of this one. Returns only where it could not be run. */
void become(char **words);

#endif
