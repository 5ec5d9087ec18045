// SPDX-License-Identifier: Apache-2.0
#ifndef GeneratedCases_h
#define GeneratedCases_h

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>

/** The number in an environment variable, or another where there is none. */
inline unsigned int
ReadEnvironment(const char * const name, const unsigned int otherwise)
{
  const char * const text = std::getenv(name);
  return text != nullptr && *text != '\0' ? static_cast<unsigned int>(std::strtoul(text, nullptr, 10)) : otherwise;
}

/** Calls \c check with the seeds of so many cases, until one fails, whose seed is told then. For other cases set
 * SUBDIVISION_SEED, the first seed, and SUBDIVISION_CASES, the number of cases of each test. Returns how many there
 * were.
 */
template <typename TCheck>
unsigned int
ForEachGeneratedCase(const unsigned int cases, const TCheck & check)
{
  const unsigned int first = ReadEnvironment("SUBDIVISION_SEED", 0);
  const unsigned int number = ReadEnvironment("SUBDIVISION_CASES", cases);
  unsigned int       done = 0;
  for (; done < number && !testing::Test::HasFailure(); ++done)
  {
    const unsigned int seed = first + done;
    SCOPED_TRACE("to repeat it alone: SUBDIVISION_SEED=" + std::to_string(seed) + " SUBDIVISION_CASES=1");
    check(seed);
  }
  std::cout << "[  cases   ] " << done << " from seed " << first << std::endl;
  return done;
}

#endif
