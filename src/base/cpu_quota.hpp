#pragma once

#include <string>

namespace gale::detail {

/// How many CPUs a quota amounts to, rounded up, from the text of a control group's files; 0 where there is none, or
/// where the text isn't understood. Version 2 has one file, cpu.max: "150000 100000" is a quota and a period in
/// microseconds, "max 100000" none.
int cpus_of_quota(const std::string& cpu_max);

/// Version 1 has two: cpu.cfs_quota_us, -1 for none, and cpu.cfs_period_us.
int cpus_of_quota(const std::string& quota, const std::string& period);

/// The processors of the container that the process runs in; 0 where it has no quota.
int cpu_quota();

/// The cores that the process may run on: those of its affinity, and no more than its quota. At least 1.
int available_cores();

}  // namespace gale::detail
