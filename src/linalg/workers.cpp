#include "linalg/workers.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <system_error>

#include "core/host_environment.hpp"
#include "linalg/tuning.hpp"

namespace jam::inside {

Workers::Workers(int threads, bool cuts) : cuts_(cuts) {
  try {
    for (int worker = 1; worker < threads; ++worker) {
      threads_.emplace_back([this, worker, host = OwnEnvironment::host()] {
        const OwnEnvironment of_call(host);
        serve(worker);
      });
    }
  } catch (const std::system_error &) {
  } catch (const std::bad_alloc &) {
  }
}

Workers::~Workers() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
  }
  more_.notify_all();
  for (std::thread &t : threads_) t.join();
}

int Workers::parts(double work, double size) const {
  return cuts_ ? static_cast<int>(std::min<double>(ThreadTuning::most_parts, std::max(1.0, std::ceil(work / size))))
               : 1;
}

void Workers::take_parts(std::unique_lock<std::mutex> &lock, int worker) {
  while (next_ < parts_) {
    const int part = next_++;
    ++running_;
    const Job job = job_;
    lock.unlock();
    struct Return {
      Workers &of;
      std::unique_lock<std::mutex> &lock;
      bool thrown = true;
      ~Return() {
        lock.lock();
        if (thrown) of.next_ = of.parts_;
        --of.running_;
      }
    } back{*this, lock};
    job.call(job.of, part, worker);
    back.thrown = false;
  }
}

void Workers::share(int parts, const Job &job) {
  std::unique_lock<std::mutex> lock(mutex_);
  job_ = job, next_ = 0, parts_ = parts;
  more_.notify_all();
  struct Wait {
    Workers &of;
    std::unique_lock<std::mutex> &lock;
    ~Wait() {
      of.done_.wait(lock, [this] { return of.running_ == 0; });
    }
  } others{*this, lock};
  take_parts(lock, 0);
}

void Workers::serve(int worker) {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    more_.wait(lock, [this] { return over_ || next_ < parts_; });
    if (over_) return;
    take_parts(lock, worker);
    if (running_ == 0) done_.notify_one();
  }
}

}  // namespace jam::inside
