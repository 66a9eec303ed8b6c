// Dense kernels on the front of a supernode, a column-major panel whose first rows are its own columns. Real: double or
// float.
#pragma once
#include <chrono>
#include <future>
#include <system_error>

#include "core/call_scope.hpp"
#include "core/host_environment.hpp"
#include "linalg/workers.hpp"

namespace jam::inside {

// A pivot at or below max(relative * its entry in the matrix, floor) is lost. It is replaced by that bound (raise), or
// by a huge number.
struct PivotRule {
  double relative, floor;
  bool raise = false;
};

// Cholesky of the first `columns` columns of a panel of `rows` rows. original: the diagonal in the matrix. Returns how
// many pivots were replaced.
template <class Real>
int factor_panel(Real *panel, int ld, int rows, int columns, const Real *original, const PivotRule &rule,
                 Workers &workers);
// C = -B B^T, lower triangle of n rows; B has k columns.
template <class Real>
void minus_square(Real *c, int n, const Real *b, int ldb, int k, Workers &workers);
// With the factored panel, for nrhs vectors in x: top := L_top^-1 top, then below := L_below top. And back: top :=
// L_top^-T (top - L_below^T below).
template <class Real>
void panel_forward(const Real *panel, int ld, int rows, int columns, Real *top, int ldt, Real *below, int ldb, int nrhs,
                   Workers &workers);
template <class Real>
void panel_backward(const Real *panel, int ld, int rows, int columns, Real *top, int ldt, const Real *below, int ldb,
                    int nrhs, Workers &workers);

// Long work during which a callback is called.

// Runs work(), which must not throw and cannot ask the monitor by itself, on another thread, while this one calls the
// callback. The work is the same, so are the bits. A call that is cancelled is left when the work has ended.
template <class Work>
void report_while(const Work &work) {
  constexpr std::chrono::milliseconds between_looks(20);
  if (!CallScope::has_callback()) return work();
  std::future<void> done;
  try {
    done = std::async(std::launch::async, [&work, host = OwnEnvironment::host()] {
      const OwnEnvironment of_call(host);
      work();
    });
  } catch (const std::system_error &) {
    return work();
  }
  while (done.wait_for(between_looks) != std::future_status::ready) CallScope::look();
}

}  // namespace jam::inside
