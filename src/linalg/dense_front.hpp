// Dense kernels on the front of a supernode, a column-major panel whose first rows are its own columns.
#pragma once

namespace jam {

// A pivot at or below max(relative * its entry in the matrix, floor) is lost and replaced by a huge number.
struct PivotRule {
  double relative, floor;
};

// Cholesky of the first `columns` columns of a panel of `rows` rows. original: the diagonal in the matrix. Returns how
// many pivots were replaced.
int factor_panel(double *panel, int ld, int rows, int columns, const double *original, const PivotRule &rule,
                 int threads);
// C = -B B^T, lower triangle of n rows; B has k columns.
void minus_square(double *c, int n, const double *b, int ldb, int k, int threads);
// With the factored panel, for nrhs vectors in x: top := L_top^-1 top, then below := L_below top. And back: top :=
// L_top^-T (top - L_below^T below).
void panel_forward(const double *panel, int ld, int rows, int columns, double *top, int ldt, double *below, int ldb,
                   int nrhs, int threads);
void panel_backward(const double *panel, int ld, int rows, int columns, double *top, int ldt, const double *below,
                    int ldb, int nrhs, int threads);

}  // namespace jam
