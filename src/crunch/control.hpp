// What every phase of a crunch does with its state: stop, begin again, report and record a step.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

void stop(CrunchState &s, jam_stop_reason reason, jam_status status);
// Where the call was cancelled or its time is over: stops for that reason. True when it did.
bool stop_if_interrupted(CrunchState &s);
// Clears contacts and verdict of the report, because the spheres will move again.
void forget_contacts(CrunchState &s);
// LPs begin again with this bound: the packing was moved, or its cell is free now.
void restart_lps(CrunchState &s, double bound);

// Part of the crunch that is done: at this part of a path (NaN: off it), or after an LP with this gain.
double part_done(const CrunchState &s, double path, double gain);
// Calls the progress callback immediately; with `finished` it may read the details of the last step. True: stop.
bool report_step(CrunchState &s, jam_phase phase, double gain, double step, bool finished = true);

// A move that opens contacts and is no step of the path: its row, and its callback.
void record_opening(CrunchState &s);
// A row of the history for the move since the last row; `displacement` as in History::moved.
HistoryRow &record_step(CrunchState &s, jam_step_phase phase, const double *displacement = nullptr);
// Its columns of the network: so many contacts, and those of each sphere.
void record_contacts(CrunchState &s, HistoryRow &row, size_t contacts, const std::vector<int32_t> &coordination);

}  // namespace jam::inside
