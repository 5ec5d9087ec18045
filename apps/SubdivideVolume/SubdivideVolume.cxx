// SPDX-License-Identifier: Apache-2.0
// Doubles the resolution of an image file. See SubdivideVolume --help.

#include "FileIntegrity.h"
#include "LibraryMessages.h"
#include "MemoryPlan.h"
#include "OneLineMessage.h"
#include "Options.h"
#include "Subdivide.h"
#include "WatchedRun.h"

#include "itkMultiThreaderBase.h"

#include <cstdio>
#include <new>

#include <unistd.h>

namespace
{
enum ExitCode
{
  Success = 0,
  RunFailed = 1,
  WrongUsage = 2
};

[[noreturn]] void
Fail(ExitCode code, const std::string & message)
{
  std::fprintf(GetTerminal(), "SubdivideVolume: %s\n", MakeOneLine(message).c_str());
  EndRun(code);
}

void
Warn(const Options & options, const std::string & message)
{
  if (!options.Quiet)
  {
    std::fprintf(GetTerminal(), "SubdivideVolume: warning: %s\n", message.c_str());
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
  return isatty(fileno(GetTerminal())) ? Progress::Style::Bar : Progress::Style::Lines;
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

/** Exceptions of ITK itself do not always name the file. */
template <typename TFunction>
auto
NameFile(const std::string & path, TFunction && function)
{
  try
  {
    return function();
  }
  catch (const itk::MemoryAllocationError &)
  {
    throw std::bad_alloc();
  }
  catch (const itk::ExceptionObject & error)
  {
    throw std::runtime_error("cannot process " + path + ": " + error.GetDescription());
  }
}

SubdivisionReport
SubdivideAnyType(const SubdivisionJob & job)
{
  return NameFile(job.Options.Input, [&job] {
    return WithComponentType(job.Input.Component, [&job](auto type) { return Subdivide<decltype(type)>(job); });
  });
}

void
Run(const Options & options)
{
  const LibraryMessages messages;
  const WatchedTask     task("cannot process " + options.Input);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(GetNumberOfThreads(options));
  const InputImage     input = NameFile(options.Input, [&options] {
    const WatchedOpening opening(options.Input);
    return OpenInput(options.Input, options.Series);
  });
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
  CheckMessages(options.Input, messages.GetText());
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

int
RunProgram(int argc, char * argv[])
{
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
    Fail(WrongUsage, std::string(error.what()) + " (see --help)");
  }
  catch (const std::bad_alloc &)
  {
    Fail(RunFailed, "there is not enough memory; try --memory or --streams, with .mha or .mhd files");
  }
  catch (const std::exception & error)
  {
    Fail(RunFailed, error.what());
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  return RunWatched([&] { return RunProgram(argc, argv); });
}
