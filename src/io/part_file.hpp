// Files that are being written, beside their target under a name of their own.
#pragma once
#include <string>

namespace jam::inside {

// Makes a new file beside `target` under a lock, and returns its descriptor: -1 with errno where that fails.
int open_part(const std::string &target, std::string &name);
// Removes what killed writers of this target have left. A file is one of theirs when its name holds the checksum that
// only libjam puts there, this user owns it, and no process has its lock. What fails here is no error.
void remove_orphans(const std::string &target);

}  // namespace jam::inside
