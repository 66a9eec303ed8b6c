// Threads of one call. They take parts of dense products and panels, subtrees, and isoconfigurational runs. Which parts
// there are depends on the sizes and on `cuts` alone, and no two parts write to the same place: the bits are the same
// for every number of threads above one.
#pragma once
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace jam::inside {

class Workers {
 public:
  // If the system starts fewer threads, those that run take all parts.
  explicit Workers(int threads) : Workers(threads, threads > 1) {}
  // cuts: whether work is cut into parts. A call that requested several threads and got one cuts too, for the same
  // bits.
  Workers(int threads, bool cuts);
  ~Workers();
  Workers(const Workers &) = delete;
  Workers &operator=(const Workers &) = delete;

  // Number of equal parts: work / size rounded up, at most ThreadTuning::most_parts; 1 where work is not cut.
  int parts(double work, double size) const;

  // work(part, worker) for all parts, each worker below the number of threads; this thread is worker 0. Only on this
  // thread may work() throw: no part begins then, and those that run are waited for.
  template <class Work>
  void run(int parts, const Work &work) {
    if (parts < 2 || threads_.empty()) {
      for (int part = 0; part < parts; ++part) work(part, 0);
      return;
    }
    share(parts, {&work, [](const void *of, int part, int worker) { (*static_cast<const Work *>(of))(part, worker); }});
  }

 private:
  struct Job {
    const void *of = nullptr;
    void (*call)(const void *of, int part, int worker) = nullptr;
  };
  void share(int parts, const Job &job);
  void take_parts(std::unique_lock<std::mutex> &lock, int worker);
  void serve(int worker);

  const bool cuts_;
  std::mutex mutex_;
  std::condition_variable more_, done_;
  Job job_;
  int next_ = 0, parts_ = 0, running_ = 0;
  bool over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace jam::inside
