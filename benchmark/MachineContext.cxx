// SPDX-License-Identifier: Apache-2.0
#include "MachineContext.h"

#include "NonOscillatorySubdivision/Target.h"
#include "itkVersion.h"

#include <benchmark/benchmark.h>

#include <fstream>
#include <string>

namespace subdivision_benchmark
{
namespace
{

/** The first line of a file that starts with `prefix`, from the `:` on if it has one; "unknown" without such a line. */
std::string
ReadLine(const std::string & path, const std::string & prefix)
{
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    if (line.compare(0, prefix.size(), prefix) == 0)
    {
      const auto colon = line.find(": ");
      return colon == std::string::npos ? line : line.substr(colon + 2);
    }
  }
  return "unknown";
}

std::string
GetCompiler()
{
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "gcc " __VERSION__;
#elif defined(_MSC_VER)
  return "msvc " + std::to_string(_MSC_VER);
#else
  return "unknown";
#endif
}

} // namespace

void
AddMachineContext()
{
  benchmark::AddCustomContext("processor", ReadLine("/proc/cpuinfo", "model name"));
  benchmark::AddCustomContext("transparent_huge_pages", ReadLine("/sys/kernel/mm/transparent_hugepage/enabled", ""));
  benchmark::AddCustomContext("itk", itk::Version::GetITKVersion());
  benchmark::AddCustomContext("compiler", GetCompiler());
  benchmark::AddCustomContext("kernel_target", itk::Subdivision::Target::Fastest().GetName());
}

} // namespace subdivision_benchmark
