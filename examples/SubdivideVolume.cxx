// SPDX-License-Identifier: Apache-2.0
// Doubles the resolution of an image file. See SubdivideVolume --help.

#include "Interrupt.h"
#include "LibraryMessages.h"
#include "MemoryPlan.h"
#include "Options.h"
#include "Subdivide.h"

#include "itkMultiThreaderBase.h"

#include <cstdio>
#include <new>
#include <regex>

#include <unistd.h>

namespace
{
enum ExitCode
{
  Success = 0,
  RunFailed = 1,
  WrongUsage = 2
};

/** The message in one line, without ITK's own prefix. */
std::string
MakeOneLine(const std::string & message)
{
  const std::string text = std::regex_replace(message, std::regex("ITK ERROR: \\w+\\(0x[0-9a-f]+\\): "), "");
  const std::string line = std::regex_replace(text, std::regex("\\s+"), " ");
  const auto        last = line.find_last_not_of(' ');
  return last == std::string::npos ? "unknown error" : line.substr(line.front() == ' ' ? 1 : 0, last + 1);
}

int
Fail(ExitCode code, const std::string & message)
{
  std::fprintf(stderr, "SubdivideVolume: %s\n", MakeOneLine(message).c_str());
  return code;
}

void
Warn(const Options & options, const std::string & message)
{
  if (!options.Quiet)
  {
    std::fprintf(stderr, "SubdivideVolume: warning: %s\n", message.c_str());
  }
}

Progress::Style
GetProgressStyle(const Options & options)
{
  if (options.ProgressXml)
  {
    return Progress::Style::Slicer;
  }
  if (options.Quiet)
  {
    return Progress::Style::None;
  }
  return isatty(STDERR_FILENO) ? Progress::Style::Bar : Progress::Style::Lines;
}

template <typename T>
std::string
Join(const std::vector<T> & values)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    text << (i > 0 ? " x " : "") << values[i];
  }
  return text.str();
}

void
PrintImage(const char * name, const ImageGrid & grid, PixelComponent component, const PixelRange & range)
{
  std::printf("%-6s  %s %s, spacing %s, range %g to %g\n",
              name,
              Join(grid.Size).c_str(),
              GetPixelComponentName(component).c_str(),
              Join(grid.Spacing).c_str(),
              range.Minimum,
              range.Maximum);
}

SubdivisionReport
SubdivideAnyType(const SubdivisionJob & job)
{
  return WithComponentType(job.Input.Component,
                           [&job](auto type) { return Subdivide<decltype(type)>(job); });
}

void
Run(const Options & options)
{
  const LibraryMessages messages;
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(GetNumberOfThreads(options));
  const InputImage     input = OpenInput(options.Input, options.Series);
  OutputImage          output(options.Output, options.Compress);
  const PixelComponent component =
    options.OutputType == "same" ? input.Component : GetPixelComponent(options.OutputType);
  if (options.Streams > 1 && !output.CanStream())
  {
    Warn(options, "the output cannot be written in pieces; --streams does nothing");
  }
  else if (options.Streams > 1 && !input.CanStream)
  {
    Warn(options, "the input cannot be read in pieces; all of it is held in memory");
  }

  Progress                progress(GetProgressStyle(options));
  const SubdivisionReport report = SubdivideAnyType({ options, input, output, component, progress });
  output.Commit();
  progress.Finish();
  if (!options.Quiet)
  {
    PrintImage("input", report.InputGrid, input.Component, report.InputRange);
    PrintImage("output", report.OutputGrid, component, report.OutputRange);
    std::printf("%-6s  %.2f s, %zu piece%s\n",
                "time",
                progress.GetSeconds(),
                report.NumberOfPieces,
                report.NumberOfPieces == 1 ? "" : "s");
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  WatchForInterrupts();
  try
  {
    Options                  options;
    const std::optional<int> exitCode = ParseCommandLine(argc, argv, options);
    if (exitCode)
    {
      return *exitCode;
    }
    Run(options);
    return Success;
  }
  catch (const UsageError & error)
  {
    return Fail(WrongUsage, std::string(error.what()) + " (see --help)");
  }
  catch (const std::bad_alloc &)
  {
    return Fail(RunFailed, "there is not enough memory; try --memory or --streams, with .mha or .mhd files");
  }
  catch (const itk::ExceptionObject & error)
  {
    return Fail(RunFailed, error.GetDescription());
  }
  catch (const std::exception & error)
  {
    return Fail(RunFailed, error.what());
  }
}
