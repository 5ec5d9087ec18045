// SPDX-License-Identifier: Apache-2.0
#include "volumes/NumberGaps.h"

#include <numeric>

void
WarnOfNumberGaps(const std::string & owner, const std::vector<std::int64_t> & numbers, const WarningSink & warn)
{
  std::int64_t step = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i)
  {
    step = std::gcd(step, numbers[i] - numbers[i - 1]);
  }
  constexpr std::int64_t most = 5;
  std::int64_t           missing = 0;
  std::string            list;
  for (std::size_t i = 1; i < numbers.size(); ++i)
  {
    const std::int64_t absent = (numbers[i] - numbers[i - 1]) / step - 1;
    for (std::int64_t k = 1; k <= absent && missing + k <= most; ++k)
    {
      list += (list.empty() ? "" : ", ") + std::to_string(numbers[i - 1] + k * step);
    }
    missing += absent;
  }
  if (missing > 0)
  {
    warn(owner + " lacks the slices with the numbers " + list +
         (missing > most ? " and " + std::to_string(missing - most) + " others" : "") +
         ": those that are there are taken for neighbours");
  }
  if (step > 1)
  {
    warn("the slices of " + owner + " are numbered in steps of " + std::to_string(step) +
         ": they are taken for neighbours");
  }
}
