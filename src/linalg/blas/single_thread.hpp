// What a library of BLAS or LAPACK needs around it. Builds that call none do not compile this.
#pragma once

namespace jam::inside {

// Name of the kernel that OpenBLAS chose for this processor; the file of the library where it is not OpenBLAS.
const char *library_kernel();

// While at least one lives, OpenBLAS runs single-threaded whatever the host set: blocks are small, libjam brings its
// own threads, and the bits must not depend on the host. OpenBLAS keeps that number per process, so this is the one
// place where libjam touches process-wide state; the last one out puts the host's number back.
// threads: of libjam that call BLAS side by side. Throws std::bad_alloc where OpenBLAS would find no memory for them.
class BlasSingleThread {
 public:
  explicit BlasSingleThread(int threads = 1);
  ~BlasSingleThread();
  BlasSingleThread(const BlasSingleThread &) = delete;
  BlasSingleThread &operator=(const BlasSingleThread &) = delete;
  // How many of the threads that were requested may compute: fewer where other calls of the process compute too.
  int threads() const { return threads_; }

 private:
  int threads_;
  int more_;  // than guards around this one have counted
};

}  // namespace jam::inside
