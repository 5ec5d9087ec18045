// SPDX-License-Identifier: Apache-2.0
#include "PieceRun.h"

#include "commandline/CommandLine.h"
#include "pieces/PieceFolder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

Piece
SelectPiece(const Box & whole, const PieceChoice & choice, const bool splitsPlanes)
{
  const std::uint64_t planes = whole.size() > 2 ? whole.back().Size : 1;
  const std::uint64_t cuts = splitsPlanes ? choice.Pieces : std::min<std::uint64_t>(choice.Pieces, planes);
  const auto          boxes = SplitIntoPieces(whole, cuts);
  const auto          place = [&](std::uint64_t number) {
    return boxes.begin() + static_cast<std::ptrdiff_t>(number * boxes.size() / choice.Pieces);
  };
  return { place(choice.Number - 1), place(choice.Number) };
}

std::string
DescribePieces(const Options &                   options,
               const unsigned int                pieces,
               const std::vector<unsigned int> & missing,
               const bool                        isComplete)
{
  if (options.Json)
  {
    nlohmann::ordered_json object;
    object["program"] = "SubdivideVolume";
    object["output"]["path"] = options.Output;
    object["piece"] = options.Piece.Number;
    object["number_of_pieces"] = pieces;
    object["missing"] = missing;
    object["complete"] = isComplete;
    return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  }
  if (isComplete)
  {
    return "complete " + options.Output + "\n";
  }
  std::string text = "missing";
  for (const unsigned int piece : missing)
  {
    text += " " + std::to_string(piece);
  }
  return text + " of " + std::to_string(pieces) + "\n";
}

void
PrintMissingPieces(const Options & options)
{
  const auto writer = CreatePieceWriter(options.Output, options.Writing, [](const std::string &) {});
  const auto pieces = PieceFolder::FindNumberOfPieces(writer->GetOutput());
  const auto complete = PieceFolder::FindNumberOfCompletePieces(writer->GetOutput());
  if (!pieces && complete)
  {
    PrintResult(DescribePieces(options, *complete, {}, true));
    return;
  }
  if (!pieces)
  {
    throw std::runtime_error("no pieces of " + options.Output + " are being made: none was begun, or all are done");
  }
  PrintResult(DescribePieces(options, *pieces, PieceFolder(writer->GetOutput(), *pieces).FindMissing(), false));
}
