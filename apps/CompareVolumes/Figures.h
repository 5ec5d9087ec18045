// SPDX-License-Identifier: Apache-2.0
#ifndef Figures_h
#define Figures_h

#include "volumes/VolumeReader.h"

#include <cstdint>
#include <string>
#include <vector>

/** What is to be compared, and how. */
struct Comparison
{
  double              Peak = 0.0;                     // 0: the range of the reference
  std::vector<double> QuantileLevels = { 0.5, 0.99 }; // these come first, always
  bool                UseSpacing = false;
};

/** How far a volume is from a reference; see itk::ImageFidelityCalculator. */
struct Figures
{
  double              PeakSignalToNoiseRatio;
  double              RelativeL2Error;
  std::vector<double> QuantileLevels;
  std::vector<double> Quantiles;
  double              RelativeTotalVariation;
  double              ReferenceTotalVariation;
  double              TestTotalVariation;
  double              ReferenceMinimum;
  double              ReferenceMaximum;
  double              TestMinimum;
  double              TestMaximum;
  double              Peak;
  std::uint64_t       ComparedVoxels;
  std::uint64_t       ExcludedVoxels;
};

/** Compares two images of one number of axes and of components; the grid is the reference's. */
Figures
Compare(VolumeReader & reference, VolumeReader & test, const Comparison & comparison);

/** As an object; null stands for infinity and NaN. */
std::string
ToJson(const Figures & figures, const std::vector<std::string> & warnings);

std::string
ToText(const Figures & figures);

#endif
