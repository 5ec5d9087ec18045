// SPDX-License-Identifier: Apache-2.0
#include "FilterOptions.h"

#include <map>
#include <stdexcept>

itk::FixedArray<bool, Axes>
GetSubdividedAxes(const Options & options, unsigned int dimension)
{
  const std::string letters("xyzt", dimension);
  const std::string chosen = options.Axes.empty() ? letters.substr(0, 3) : options.Axes;
  if (chosen.find_first_not_of(letters) != std::string::npos)
  {
    throw std::runtime_error("--axes " + chosen + ": the image has only the axes " + letters);
  }
  itk::FixedArray<bool, Axes> axes(false);
  for (const char letter : chosen)
  {
    axes[letters.find(letter)] = true;
  }
  return axes;
}

itk::NonOscillatorySubdivisionImageFilterEnums::Scheme
GetScheme(const Options & options)
{
  using Scheme = itk::NonOscillatorySubdivisionImageFilterEnums::Scheme;
  static const std::map<std::string, Scheme> schemes = { { "nonoscillatory", Scheme::NonOscillatory },
                                                         { "linear", Scheme::Linear },
                                                         { "bounded", Scheme::BoundedLinear },
                                                         { "bspline", Scheme::BSpline } };
  return schemes.at(options.Scheme);
}
