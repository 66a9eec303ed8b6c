/* Writing: whole or not at all, nothing left behind, nobody's file harmed. */
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include "io_helpers.h"

static const char old_text[] = "what was here before\n";

CASE(targets_that_cannot_be_written_are_refused) {
  OWNED jam_system *sys = some_packing(3, 50, 1.0, 1.0);
  int files = count_files();
  assert_int_equal(jam_write(sys, NULL, 0), JAM_E_NULL);
  assert_int_equal(jam_write(sys, in_scratch("x.dat"), 5), JAM_E_ARGUMENT);
  assert_int_equal(jam_write(sys, in_scratch("x.dat"), -1), JAM_E_ARGUMENT);
  SAYS(jam_write(sys, in_scratch("no/such/folder.dat"), 0), JAM_E_IO, strerror(ENOENT));
  SAYS(jam_write(sys, scratch, 0), JAM_E_IO, strerror(EISDIR));
  assert_int_equal(jam_write(sys, "", 0), JAM_E_IO);
  assert_int_equal(count_files(), files);
}

/* A full disk: the special file /dev/full, and a file-size limit in the middle of the temporary file, whose signal
 * would end the process. */
CASE(a_full_disk_leaves_the_old_file) {
  OWNED jam_system *sys = some_packing(3, 400, 1.4, 1.0);
  struct rlimit limit, small;
  const char *path = in_scratch("precious.dat");
  if (access("/dev/full", W_OK) == 0) {
    SAYS(jam_write(sys, "/dev/full", 0), JAM_E_IO, strerror(ENOSPC));
    assert_int_equal(access("/dev/full", W_OK), 0); /* not renamed over */
  }
  put_bytes(path, old_text, strlen(old_text));
  int files = count_files();
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
  small = limit;
  small.rlim_cur = 1000;
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  jam_status status = jam_write(sys, path, 0);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
  SAYS(status, JAM_E_IO, strerror(EFBIG));
  assert_int_equal(count_files(), files); /* no temporary file is left */
  assert_bytes(path, old_text, strlen(old_text));
  assert_int_equal(jam_write(sys, path, 0), JAM_OK); /* and it works when there is room again */
  assert_int_equal(count_files(), files);
}

CASE(links_and_permissions_are_kept) {
  OWNED jam_system *sys = some_packing(3, 5, 1.0, 1.0), *back = NULL;
  const char *real = in_scratch("real.dat"), *link = in_scratch("link.dat"), *dangling = in_scratch("dangling.dat");
  struct stat there;
  put_bytes(real, old_text, strlen(old_text));
  assert_int_equal(chmod(real, 0640), 0);
  assert_int_equal(symlink("real.dat", link), 0);
  assert_int_equal(jam_write(sys, link, 0), JAM_OK);
  assert_int_equal(lstat(link, &there), 0);
  assert_true(S_ISLNK(there.st_mode)); /* the link still is one, its target has the packing and its old mode */
  assert_int_equal(lstat(real, &there), 0);
  assert_int_equal(there.st_mode & 0777, 0640);
  assert_int_equal(jam_read(real, NULL, NULL, NULL, &back), JAM_OK);
  assert_same_bits(sys, back);
  assert_int_equal(symlink("later.dat", dangling), 0);
  assert_int_equal(jam_write(sys, dangling, 0), JAM_OK);
  assert_int_equal(lstat(in_scratch("later.dat"), &there), 0);
  mode_t mask = umask(022);
  umask(mask);
  assert_int_equal(there.st_mode & 0777, 0666 & ~mask);
}

/* The new file has the owner's permissions, and not the bits that lend the rights of its new owner. */
CASE(no_rights_are_lent) {
  OWNED jam_system *sys = some_packing(3, 5, 1.0, 1.0);
  const char *path = in_scratch("lent.dat");
  for (int k = 0; k < 3; ++k) {
    struct stat there;
    put_bytes(path, old_text, strlen(old_text));
    if (geteuid() == 0) assert_int_equal(chown(path, 65534, 65534), 0);
    assert_int_equal(chmod(path, 07751), 0);
    jam_status status = k == 0   ? jam_write(sys, path, JAM_FORMAT_PLAIN)
                        : k == 1 ? jam_write_checkpoint(sys, path)
                                 : jam_write_page(sys, path, "", 0, "", NULL, 0);
    assert_int_equal(status, JAM_OK);
    assert_int_equal(stat(path, &there), 0);
    assert_int_equal(there.st_mode & 07777, 0751);
    if (geteuid() == 0) assert_int_equal(there.st_uid, 65534); /* as after a plain rewrite */
    if (geteuid() == 0) assert_int_equal(there.st_gid, 65534);
    assert_int_equal(unlink(path), 0);
  }
}

typedef struct pipe_writer {
  jam_system *sys;
  const char *path;
  jam_status status;
} pipe_writer;

static void *write_to_pipe(void *with) {
  pipe_writer *const job = with;
  job->status = jam_write(job->sys, job->path, JAM_FORMAT_XYZ);
  return NULL;
}

static void *read_a_little(void *path) {
  char bytes[64];
  const int fd = open(path, O_RDONLY);
  (void)!read(fd, bytes, sizeof bytes);
  close(fd);
  return NULL;
}

/* A pipe that nobody reads, that somebody stops to read, and a thread that its host cancels there. */
CASE(pipes_leave_the_host_alone) {
  pipe_writer job = {some_packing(3, 20000, 1.0, 1.0), in_scratch("pipe"), JAM_OK};
  struct timespec moment = {0, 200000000};
  pthread_t thread;
  sigset_t pending;
  void *result;
  assert_int_equal(mkfifo(job.path, 0600), 0);
  pthread_create(&thread, NULL, read_a_little, (void *)job.path);
  write_to_pipe(&job); /* SIGPIPE would end this process */
  pthread_join(thread, NULL);
  SAYS(job.status, JAM_E_IO, strerror(EPIPE));
  sigpending(&pending);
  assert_false(sigismember(&pending, SIGPIPE));
  pthread_create(&thread, NULL, write_to_pipe, &job); /* without a reader */
  nanosleep(&moment, NULL);
  assert_int_equal(jam_cancel(job.sys), JAM_OK);
  pthread_join(thread, NULL);
  assert_int_equal(job.status, JAM_CANCELLED);
  int fd = open(job.path, O_RDWR); /* a reader that does not read */
  pthread_create(&thread, NULL, write_to_pipe, &job);
  nanosleep(&moment, NULL);
  pthread_cancel(thread);
  pthread_join(thread, &result);
  assert_ptr_equal(result, PTHREAD_CANCELED);
  close(fd);
  assert_int_equal(jam_write(job.sys, in_scratch("after.xyz"), 0), JAM_OK); /* the handle is free */
  jam_destroy(job.sys);
}

CASE(read_only_files_are_kept) {
  OWNED jam_system *sys = some_packing(3, 5, 1.0, 1.0);
  const char *path = in_scratch("readonly.dat");
  if (geteuid() == 0) {
    jam_destroy(sys);
    print_message("root may write anything: skipped\n");
    skip();
  }
  put_bytes(path, old_text, strlen(old_text));
  assert_int_equal(chmod(path, 0444), 0);
  assert_int_equal(jam_write(sys, path, 0), JAM_E_IO);
  assert_bytes(path, old_text, strlen(old_text));
}

FIXTURE(make_scratch, remove_scratch)
