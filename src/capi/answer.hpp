// What a call answers: its status, and the sentence that jam_last_error gives for one above zero.
#pragma once
#include <string>
#include <utility>

#include "core/sentence.hpp"
#include "jam/jam.h"

namespace jam::inside {

struct Answer {
  jam_status status;
  std::string text;  // empty: text_of_status(status)
  Answer(jam_status code) : status(code) {}
  Answer(jam_status code, std::string why) : status(code), text(std::move(why)) {}
};

// status.cpp: what a status above zero means where a call has no more to say.
const char *text_of_status(jam_status status);
// Of a call that ended for a jam_stop_reason: what stopped it, and the way out.
Answer stopped(jam_status status, int32_t stop_reason);

// The same of runs that continue with resume = 1; another call starts again.
Answer stopped_run(jam_status status, int32_t stop_reason);

}  // namespace jam::inside
