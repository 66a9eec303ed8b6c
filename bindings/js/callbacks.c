/* Callbacks of C that call JavaScript: each gets the number of its function there as `user`. */
#include <jam/jam.h>

#define FROM_JS(name) __attribute__((import_module("jam"), import_name(#name)))

FROM_JS(progress) int32_t jam_js_progress(const jam_progress *progress, void *user);
FROM_JS(log) void jam_js_log(int32_t level, const char *line, void *user);

static int32_t progress(const jam_progress *now, void *user) { return jam_js_progress(now, user); }
static void log_line(int32_t level, const char *line, void *user) { jam_js_log(level, line, user); }

JAM_API jam_progress_fn jam_wasm_progress(void) { return progress; }
JAM_API jam_log_fn jam_wasm_log(void) { return log_line; }
