// SPDX-License-Identifier: Apache-2.0
#ifndef Summary_h
#define Summary_h

#include "Options.h"
#include "Plan.h"
#include "Statistics.h"
#include "volumes/ImageDescription.h"

#include <string>
#include <vector>

/** What a run has done. */
struct Summary
{
  const ::Options &        Options;
  const ImageDescription & Input;
  const ImageDescription & Output;
  Statistics               InputStatistics;
  Statistics               OutputStatistics;
  ::Losses                 Losses;
  std::vector<std::string> Warnings;
  std::size_t              Pieces = 0;
  unsigned int             Threads = 0;
  double                   Seconds = 0.0;
};

/** In lines, or as an object where the options ask for JSON. */
std::string
Describe(const Summary & summary);

/** What a run would do. */
struct Forecast
{
  const ::Options &        Options;
  const ImageDescription & Input;
  const ImageDescription & Output;
  const ::Plan &           Plan;
  std::vector<std::string> Warnings;
  unsigned int             Threads = 0;
};

std::string
Describe(const Forecast & forecast);

#endif
