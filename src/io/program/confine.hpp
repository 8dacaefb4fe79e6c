#pragma once

namespace gale::reader {

/// Keeps this process from opening any file, socket or anything else, and from running programs: it reads, writes and
/// maps what it has open already, takes memory, and ends. Does each of the three below that the kernel has; the last is
/// always there.
void confine();

/// Landlock, Linux 5.13: no path is opened, created or run; no connection over TCP, no signal to others (6.7, 6.12).
bool confine_by_landlock();

/// A filter of system calls: all fail but a few. On processors whose numbers of system calls we know.
bool confine_by_filter();

/// No new descriptors.
bool confine_by_limits();

}  // namespace gale::reader
