// Monte Carlo in 3 dimensions. One file a dimension keeps each compilation short.
#include "dynamics/monte_carlo_trials.hpp"

namespace jam {

template std::unique_ptr<MonteCarlo> make_monte_carlo_of<3>(const Packing &, const jam_monte_carlo_options &, int64_t);

}  // namespace jam
