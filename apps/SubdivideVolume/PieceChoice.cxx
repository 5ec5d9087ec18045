// SPDX-License-Identifier: Apache-2.0
#include "PieceChoice.h"

#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace
{
constexpr unsigned int MostPieces = 1000000;

/** A number without a sign and of nothing but digits. */
std::optional<unsigned int>
ParseNumber(const std::string & text)
{
  constexpr std::size_t longest = 9;
  if (text.empty() || text.size() > longest || text.find_first_not_of("0123456789") != std::string::npos)
  {
    return std::nullopt;
  }
  return static_cast<unsigned int>(std::stoul(text));
}

std::optional<unsigned int>
ReadVariable(const char * name)
{
  const char * const text = std::getenv(name);
  return text == nullptr ? std::nullopt : ParseNumber(text);
}

/** \param number counted from 0 */
PieceChoice
Choose(const unsigned int number, const unsigned int pieces)
{
  return { false, number + 1, pieces };
}

std::optional<PieceChoice>
FindRank(const char * rankName, const char * sizeName)
{
  const auto rank = ReadVariable(rankName);
  const auto size = ReadVariable(sizeName);
  return rank && size && *rank < *size ? std::optional<PieceChoice>(Choose(*rank, *size)) : std::nullopt;
}

/** The tasks of a job array have numbers with a step between them; lists like 1,2,5 have no order to go by. */
std::optional<PieceChoice>
FindArrayTask()
{
  const auto         task = ReadVariable("SLURM_ARRAY_TASK_ID");
  const auto         count = ReadVariable("SLURM_ARRAY_TASK_COUNT");
  const auto         first = ReadVariable("SLURM_ARRAY_TASK_MIN");
  const auto         last = ReadVariable("SLURM_ARRAY_TASK_MAX");
  const unsigned int step = ReadVariable("SLURM_ARRAY_TASK_STEP").value_or(1);
  if (!task || !count || !first)
  {
    return std::nullopt;
  }
  const bool isRegular = step > 0 && *task >= *first && (*task - *first) % step == 0 &&
                         (*task - *first) / step < *count && (!last || (*last - *first) / step + 1 == *count);
  if (!isRegular)
  {
    throw std::invalid_argument("the tasks of the Slurm job array are not evenly numbered; give --piece K/N");
  }
  return Choose((*task - *first) / step, *count);
}

PieceChoice
FindRank()
{
  std::optional<PieceChoice> found;
  for (const auto & choice : { FindRank("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
                               FindRank("PMI_RANK", "PMI_SIZE"),
                               FindArrayTask(),
                               FindRank("SLURM_PROCID", "SLURM_NTASKS") })
  {
    // A launcher within another one may run one process only.
    if (choice && (!found || found->Pieces == 1))
    {
      found = choice;
    }
  }
  if (!found)
  {
    throw std::invalid_argument("no rank and size are in the environment: neither OMPI_COMM_WORLD_RANK, PMI_RANK, "
                                "SLURM_ARRAY_TASK_ID nor SLURM_PROCID with what goes with it");
  }
  return *found;
}
} // namespace

PieceChoice
ParsePieceChoice(const std::string & text)
{
  if (text == "status")
  {
    return { true, 0, 1 };
  }
  if (text == "rank")
  {
    return FindRank();
  }
  const auto separator = text.find('/');
  const auto number = ParseNumber(text.substr(0, separator));
  const auto pieces = separator == std::string::npos ? std::nullopt : ParseNumber(text.substr(separator + 1));
  if (!number || !pieces || *number < 1 || *number > *pieces || *pieces > MostPieces)
  {
    throw std::invalid_argument("it must be K/N with K from 1 to N, such as 3/16, or rank, or status, not " + text);
  }
  return Choose(*number - 1, *pieces);
}
