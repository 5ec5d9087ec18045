// SPDX-License-Identifier: Apache-2.0
#ifndef ProcessUsage_h
#define ProcessUsage_h

#if defined(__unix__) || defined(__APPLE__)
#  include <sys/resource.h>
#endif

namespace subdivision_benchmark
{

/** What the process has cost so far: page faults served without the disk, and processor seconds of all its threads. */
struct ProcessUsage
{
  double MinorFaults{ 0.0 };
  double UserSeconds{ 0.0 };
  double SystemSeconds{ 0.0 };
};

inline ProcessUsage
operator-(const ProcessUsage & a, const ProcessUsage & b)
{
  return { a.MinorFaults - b.MinorFaults, a.UserSeconds - b.UserSeconds, a.SystemSeconds - b.SystemSeconds };
}

inline ProcessUsage &
operator+=(ProcessUsage & a, const ProcessUsage & b)
{
  a.MinorFaults += b.MinorFaults;
  a.UserSeconds += b.UserSeconds;
  a.SystemSeconds += b.SystemSeconds;
  return a;
}

/** The usage up to now; all zero on systems without getrusage. */
inline ProcessUsage
GetProcessUsage()
{
  ProcessUsage usage;
#if defined(__unix__) || defined(__APPLE__)
  rusage now{};
  getrusage(RUSAGE_SELF, &now);
  usage.MinorFaults = static_cast<double>(now.ru_minflt);
  usage.UserSeconds = now.ru_utime.tv_sec + 1e-6 * now.ru_utime.tv_usec;
  usage.SystemSeconds = now.ru_stime.tv_sec + 1e-6 * now.ru_stime.tv_usec;
#endif
  return usage;
}

} // namespace subdivision_benchmark

#endif
