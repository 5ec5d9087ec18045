// SPDX-License-Identifier: Apache-2.0
#include "MultiplyAddPeak.h"

#ifdef NonOscillatorySubdivision_BENCHMARK_WITH_HIGHWAY

#  undef HWY_TARGET_INCLUDE
#  define HWY_TARGET_INCLUDE "MultiplyAddTargets.cxx"
#  include <hwy/foreach_target.h>
#  include <hwy/highway.h>

#  include <benchmark/benchmark.h>

HWY_BEFORE_NAMESPACE();
namespace subdivision_benchmark
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// Twelve independent chains cover the latency of two multiply-adds a cycle, and with the factor fit into 16 registers.
// They start from different values: the compiler would merge equal ones.
double
MultiplyAdds(std::uint64_t rounds)
{
  const hn::ScalableTag<float> d;
  const auto                   half = hn::Set(d, 0.5f);
  auto a0 = hn::Set(d, 0.0f), a1 = hn::Set(d, 2.0f), a2 = hn::Set(d, 3.0f), a3 = hn::Set(d, 4.0f);
  auto a4 = hn::Set(d, 5.0f), a5 = hn::Set(d, 6.0f), a6 = hn::Set(d, 7.0f), a7 = hn::Set(d, 8.0f);
  auto a8 = hn::Set(d, 9.0f), a9 = hn::Set(d, 10.0f), a10 = hn::Set(d, 11.0f), a11 = hn::Set(d, 12.0f);
  for (std::uint64_t i = 0; i < rounds; ++i)
  {
    a0 = hn::MulAdd(a0, half, half);
    a1 = hn::MulAdd(a1, half, half);
    a2 = hn::MulAdd(a2, half, half);
    a3 = hn::MulAdd(a3, half, half);
    a4 = hn::MulAdd(a4, half, half);
    a5 = hn::MulAdd(a5, half, half);
    a6 = hn::MulAdd(a6, half, half);
    a7 = hn::MulAdd(a7, half, half);
    a8 = hn::MulAdd(a8, half, half);
    a9 = hn::MulAdd(a9, half, half);
    a10 = hn::MulAdd(a10, half, half);
    a11 = hn::MulAdd(a11, half, half);
  }
  const auto low = hn::Add(hn::Add(hn::Add(a0, a1), hn::Add(a2, a3)), hn::Add(a4, a5));
  const auto high = hn::Add(hn::Add(hn::Add(a6, a7), hn::Add(a8, a9)), hn::Add(a10, a11));
  benchmark::DoNotOptimize(hn::GetLane(hn::Add(low, high)));
  return 12.0 * static_cast<double>(rounds) * static_cast<double>(hn::Lanes(d));
}

} // namespace HWY_NAMESPACE
} // namespace subdivision_benchmark
HWY_AFTER_NAMESPACE();

#  if HWY_ONCE
namespace subdivision_benchmark
{
HWY_EXPORT(MultiplyAdds);

std::vector<MultiplyAddTarget>
GetMultiplyAddTargets()
{
  std::vector<MultiplyAddTarget> targets;
  for (const auto target : hwy::SupportedAndGeneratedTargets())
  {
    hwy::GetChosenTarget().Update(target);
    targets.push_back({ hwy::TargetName(target), &HWY_DYNAMIC_DISPATCH(MultiplyAdds) });
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return targets;
}

} // namespace subdivision_benchmark
#  endif

#else

namespace subdivision_benchmark
{

std::vector<MultiplyAddTarget>
GetMultiplyAddTargets()
{
  return {};
}

} // namespace subdivision_benchmark

#endif
