// SPDX-License-Identifier: Apache-2.0
// Doubles the resolution of an image. See SubdivideVolume --help.

#include "FormatTable.h"
#include "LevelChain.h"
#include "Options.h"
#include "PieceAgreement.h"
#include "PieceRun.h"
#include "Pipeline.h"
#include "Plan.h"
#include "Progress.h"
#include "SlicerDescription.h"
#include "Summary.h"
#include "VoxelCounter.h"
#include "commandline/CommandLine.h"
#include "commandline/Warnings.h"
#include "dicom/Dicom.h"
#include "formats/CreateVolume.h"
#include "formats/Formats.h"
#include "formats/InputSafety.h"
#include "formats/OpenVolume.h"
#include "headers/Metadata.h"
#include "itk/FileIntegrity.h"
#include "pieces/PieceFolder.h"
#include "system/files/FileState.h"
#include "system/process/LibraryMessages.h"
#include "system/process/Terminal.h"
#include "system/process/WatchedRun.h"
#include "system/process/WatchedTask.h"
#include "text/LibraryWarnings.h"
#include "text/OneLineMessage.h"

#include <cstdio>
#include <filesystem>
#include <new>

namespace fs = std::filesystem;

namespace
{
ExitCode
Fail(ExitCode code, const std::string & message)
{
  std::fprintf(GetTerminal(), "SubdivideVolume: %s\n", MakeOneLine(message).c_str());
  return code;
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
  return IsSeenByUser() ? Progress::Style::Bar : Progress::Style::Lines;
}

std::unique_ptr<VolumeReader>
Open(const Options & options, Warnings & warnings)
{
  auto reader =
    OpenVolume(options.Input, options.Reading, [&warnings](const std::string & text) { warnings.Add(text); });
  if (!options.Labels && IsLabelMap(options.Input, reader->GetDescription()))
  {
    warnings.Add("the file says that its voxels are labels; between two labels others appear that mean something else, "
                 "unless --labels is given");
  }
  return reader;
}

void
WarnOfFrame(const Options & options, const ImageDescription & input, Warnings & warnings)
{
  const VolumeFormat * const format = FindVolumeFormat(options.Output);
  if (LosesMeasurementFrame(input, format != nullptr && std::string(format->Name) == "NRRD"))
  {
    warnings.Add(options.Output +
                 " cannot hold the measurement frame that the components of the image, or its gradients, refer to");
  }
}

std::unique_ptr<VolumeWriter>
Create(const Options & options, const VolumeReader & reader, unsigned int threads, Warnings & warnings)
{
  OutputOptions writing = options.Writing;
  writing.Threads = threads;
  auto writer = CreateVolume(options.Output, writing, [&warnings](const std::string & text) { warnings.Add(text); });
  CheckInputStays(options.Input, reader, options.Output, *writer, InPlace::Allowed);
  WarnOfFrame(options, reader.GetDescription(), warnings);
  return writer;
}

void
WarnOfStreams(const Options & options, const VolumeReader & reader, const VolumeWriter & writer, Warnings & warnings)
{
  if (options.Streams > 1 && !writer.WritesParts())
  {
    warnings.Add("the output cannot be written in pieces; --streams does nothing");
  }
  else if (options.Streams > 1 && !reader.ReadsParts())
  {
    warnings.Add("the input cannot be read in pieces; all of it is held in memory");
  }
}

/** What libraries warned of. */
void
PassOn(const LibraryMessages & messages, Warnings & warnings)
{
  for (const std::string & warning : FindLibraryWarnings(messages.GetText()))
  {
    warnings.Add(warning);
  }
}

/** Labels are never computed with. */
void
WarnOfRoundedInput(const Options &          options,
                   const ImageDescription & input,
                   const Statistics &       range,
                   Warnings &               warnings)
{
  if (!options.Labels)
  {
    WarnOfRounding(options.Input, input.Component, range.Minimum, range.Maximum, [&warnings](const std::string & text) {
      warnings.Add(text);
    });
  }
}

void
Inform(const Options & options)
{
  const LibraryMessages messages;
  const WatchedTask     task("cannot process " + options.Input);
  Warnings              warnings(options.Quiet);
  const unsigned int    threads = GetNumberOfThreads(options);
  const auto            reader = Open(options, warnings);
  const auto            writer = options.Output.empty() ? nullptr : Create(options, *reader, threads, warnings);
  const LevelChain      chain(reader->GetDescription(), options, threads);
  const Plan            plan = MakePlan(options, chain, { chain.GetWholeOutput() }, *reader, writer.get(), threads);
  PassOn(messages, warnings);
  PrintResult(
    Describe(Forecast{ options, reader->GetDescription(), chain.GetOutput(), plan, warnings.GetAll(), threads }));
}

void
Subdivide(const Options & options)
{
  const LibraryMessages messages;
  const WatchedTask     task("cannot process " + options.Input);
  Warnings              warnings(options.Quiet);
  const unsigned int    threads = GetNumberOfThreads(options);
  const std::string     input = DescribeFiles(options.Input);
  const auto            reader = Open(options, warnings);
  const auto            writer = Create(options, *reader, threads, warnings);
  Progress              progress(GetProgressStyle(options));
  LevelChain            chain(reader->GetDescription(), options, threads);
  const Plan            plan = MakePlan(options, chain, { chain.GetWholeOutput() }, *reader, writer.get(), threads);
  VoxelCounter          counter(chain, reader->GetDescription(), threads);
  Pipeline              pipeline(*reader, chain, *writer, counter, plan);
  WarnOfStreams(options, *reader, *writer, warnings);
  writer->Begin(chain.GetOutput());
  pipeline.Run(progress);
  CheckMessages(options.Input, messages.GetText());
  PassOn(messages, warnings);
  WarnOfRoundedInput(options, reader->GetDescription(), counter.GetInput(), warnings);
  if (!fs::is_directory(options.Input)) // others may write into a folder
  {
    CheckFiles(options.Input, input);
  }
  writer->Commit();
  progress.Finish();
  const std::string summary = Describe(Summary{ options,
                                                reader->GetDescription(),
                                                chain.GetOutput(),
                                                counter.GetInput(),
                                                counter.GetOutput(),
                                                pipeline.GetLosses(),
                                                warnings.GetAll(),
                                                plan.Pieces.size(),
                                                threads,
                                                progress.GetSeconds() });
  if (options.Json)
  {
    PrintResult(summary);
  }
  else if (!options.Quiet)
  {
    std::fputs(summary.c_str(), stdout); // the output is complete, whether or not anybody hears of it
  }
}

/** Makes a piece unless it was made, and notes it. */
void
MakePiece(const Options & options,
          VolumeReader &  reader,
          LevelChain &    chain,
          PieceWriter &   writer,
          PieceFolder &   folder,
          Warnings &      warnings)
{
  const Piece piece = SelectPiece(chain.GetWholeOutput(), options.Piece, writer.SplitsPlanes());
  if (const auto checksum = folder.FindNote(options.Piece.Number))
  {
    const fs::path where = folder.IsFinished() ? writer.GetOutput().parent_path() : folder.GetOutputFolder();
    if (writer.ReadChecksum(where, piece) == *checksum)
    {
      return;
    }
  }
  const std::string input = DescribeFiles(options.Input);
  Progress          progress(GetProgressStyle(options));
  writer.Open(folder.GetOutputFolder(), folder.MakeTemporaryFolder(), piece);
  if (!piece.empty())
  {
    const unsigned int    threads = GetNumberOfThreads(options);
    const LibraryMessages messages;
    const Plan            plan = MakePlan(options, chain, piece, reader, &writer, threads);
    VoxelCounter          counter(chain, reader.GetDescription(), threads);
    Pipeline              pipeline(reader, chain, writer, counter, plan);
    pipeline.Run(progress);
    CheckMessages(options.Input, messages.GetText());
    WarnOfRoundedInput(options, reader.GetDescription(), counter.GetInput(), warnings);
  }
  writer.Commit();
  CheckFiles(options.Input, input);
  folder.Note(options.Piece.Number, writer.ReadChecksum(folder.GetOutputFolder(), piece));
  progress.Finish();
}

void
SubdividePiece(const Options & options)
{
  const WatchedTask  task("cannot process " + options.Input);
  Warnings           warnings(options.Quiet);
  const unsigned int threads = GetNumberOfThreads(options);
  const auto         reader = Open(options, warnings);
  const auto         writer =
    CreatePieceWriter(options.Output, options.Writing, [&warnings](const std::string & text) { warnings.Add(text); });
  CheckInputStays(options.Input, *reader, options.Output, *writer, InPlace::Refused);
  WarnOfFrame(options, reader->GetDescription(), warnings);
  LevelChain chain(reader->GetDescription(), options, threads);
  writer->Begin(chain.GetOutput());
  PieceFolder folder(writer->GetOutput(), options.Piece.Pieces);
  const bool  isToDo = folder.Join(MakePieceAgreement(options, reader->GetDescription(), chain.GetOutput()), *writer);
  bool        isComplete = !isToDo;
  try
  {
    if (isToDo)
    {
      MakePiece(options, *reader, chain, *writer, folder, warnings);
      isComplete = folder.Finish(*writer);
    }
  }
  catch (const std::exception &)
  {
    // Another process that makes the same piece may have been faster, so that what this one writes into is gone.
    isComplete = folder.IsFinishedByAnother();
    if (!isComplete)
    {
      throw;
    }
  }
  const auto        missing = isComplete ? std::vector<unsigned int>() : folder.FindMissing();
  const std::string text = DescribePieces(options, options.Piece.Pieces, missing, isComplete);
  if (options.Json)
  {
    PrintResult(text);
  }
  else if (!options.Quiet)
  {
    std::fputs(text.c_str(), stdout);
  }
}

void
ListSeries(const Options & options)
{
  const LibraryMessages messages;
  PrintDicomSeries(ListDicomSeries(options.Input), stdout);
}

void
Perform(const Options & options)
{
  switch (options.Task)
  {
    case Task::Subdivide:
      return options.Piece.IsStatus     ? PrintMissingPieces(options)
             : options.Piece.Number > 0 ? SubdividePiece(options)
                                        : Subdivide(options);
    case Task::Inform:
      return Inform(options);
    case Task::ListSeries:
      return ListSeries(options);
    case Task::ListFormats:
      return PrintResult(DescribeFormats(options.Json));
    case Task::DescribeItself:
      return PrintResult(GetSlicerDescription());
  }
}
int
RunProgram(int argc, char * argv[])
{
  try
  {
    Options                  options;
    const std::optional<int> exitCode = ParseCommandLine(argc, argv, options);
    if (!exitCode)
    {
      Perform(options);
    }
    return exitCode.value_or(Success);
  }
  catch (const UsageError & error)
  {
    return Fail(WrongUsage, std::string(error.what()) + " (see --help)");
  }
  catch (const std::bad_alloc &)
  {
    return Fail(RunFailed,
                "there is not enough memory; try --memory or --streams, with files that are read and written in pieces "
                "(see --formats)");
  }
  catch (const std::exception & error)
  {
    return Fail(RunFailed, error.what());
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  return RunWatched([&] { return RunProgram(argc, argv); });
}
