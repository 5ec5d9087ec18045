// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomPositions.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace
{
using Vector = std::array<double, 3>;

double
Dot(const Vector & a, const Vector & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector
Subtract(const Vector & a, const Vector & b, double factor = 1)
{
  return { a[0] - factor * b[0], a[1] - factor * b[1], a[2] - factor * b[2] };
}

double
GetLength(const Vector & a)
{
  return std::sqrt(Dot(a, a));
}

const Vector &
GetPosition(const DicomSlice & slice)
{
  return *slice.GetFrame().Position;
}

std::string
NameSlice(const DicomSlice & slice)
{
  const std::string name = slice.Header->FileName.filename().string();
  return slice.Header->Frames.size() == 1 ? name : "frame " + std::to_string(slice.Frame + 1) + " of " + name;
}

template <typename T>
std::string
Join(const std::vector<T> & values)
{
  constexpr std::size_t most = 5;
  std::ostringstream    text;
  for (std::size_t i = 0; i < values.size() && i < most; ++i)
  {
    text << (i == 0 ? "" : ", ") << values[i];
  }
  if (values.size() > most)
  {
    text << " and " << values.size() - most << " more";
  }
  return text.str();
}

[[noreturn]] void
Refuse(const std::string & reason)
{
  throw std::runtime_error("the series is no regular volume: " + reason);
}

/** Distances along the normal. */
std::vector<double>
GetDistances(const std::vector<DicomSlice> & slices)
{
  const Vector        normal = GetSliceAxes(slices.front())[2];
  std::vector<double> distances;
  for (const DicomSlice & slice : slices)
  {
    distances.push_back(Dot(GetPosition(slice), normal));
  }
  return distances;
}

/** Slices, sorted along the normal, by the positions they stand at. */
std::vector<std::vector<DicomSlice>>
GroupByPosition(const std::vector<DicomSlice> & slices, double pixel)
{
  const std::vector<double>            distances = GetDistances(slices);
  const double                         nothing = std::min(1e-3, pixel / 100);
  std::vector<std::vector<DicomSlice>> groups;
  double                               last = 0;
  for (std::size_t i = 0; i < slices.size(); ++i)
  {
    if (groups.empty() || distances[i] - last > nothing)
    {
      groups.emplace_back();
      last = distances[i];
    }
    groups.back().push_back(slices[i]);
  }
  return groups;
}

/** Whether there is something that tells the images at one position apart. */
bool
HaveOrder(std::vector<DicomSlice> & images)
{
  const auto key = [](const DicomSlice & slice) -> const std::vector<double> & { return slice.GetFrame().PhaseKey; };
  std::sort(images.begin(), images.end(), [&key](const auto & a, const auto & b) { return key(a) < key(b); });
  return std::adjacent_find(images.begin(), images.end(), [&key](const auto & a, const auto & b) {
           return key(a) == key(b);
         }) == images.end();
}

void
CheckPhasesAreComplete(const std::vector<std::vector<DicomSlice>> & groups, double pixel)
{
  const auto bySize = [](const auto & a, const auto & b) { return a.size() < b.size(); };
  const auto [fewest, most] = std::minmax_element(groups.begin(), groups.end(), bySize);
  const Vector shift = Subtract(GetPosition(most->front()), GetPosition(most->back()));
  if (GetLength(shift) > pixel / 10)
  {
    Refuse(NameSlices(*most) + " lie side by side in one plane");
  }
  if (fewest->size() != most->size())
  {
    Refuse(std::to_string(most->size()) + " images (" + NameSlices(*most) + ") stand at one position, but " +
           std::to_string(fewest->size()) + " (" + NameSlices(*fewest) + ") at another; leave one at each");
  }
}

/** The median of the distances from slice to slice. */
double
GetUsualStep(const std::vector<double> & distances)
{
  std::vector<double> steps;
  for (std::size_t i = 1; i < distances.size(); ++i)
  {
    steps.push_back(distances[i] - distances[i - 1]);
  }
  std::nth_element(steps.begin(), steps.begin() + (steps.size() - 1) / 2, steps.end());
  return steps[(steps.size() - 1) / 2];
}

double
GetTolerance(double spacing)
{
  return std::min(std::max(0.01 * spacing, 0.01), 0.1 * spacing);
}

/** Gaps that hold whole slices. */
void
CheckNoSliceIsMissing(const std::vector<DicomSlice> & slices, const std::vector<double> & distances, double step)
{
  std::vector<double>     missing;
  std::vector<DicomSlice> beside;
  for (std::size_t i = 1; i < distances.size(); ++i)
  {
    const double     width = (distances[i] - distances[i - 1]) / step;
    const double     whole = std::round(width);
    constexpr double most = 1000;
    if (whole >= 2 && whole < most && std::abs(width - whole) * step <= whole * GetTolerance(step))
    {
      for (double k = 1; k < whole; ++k)
      {
        missing.push_back(distances[i - 1] + k * step);
      }
      beside.insert(beside.end(), { slices[i - 1], slices[i] });
    }
  }
  if (!missing.empty())
  {
    Refuse(std::to_string(missing.size()) + (missing.size() == 1 ? " slice is" : " slices are") +
           " missing, at position " + Join(missing) + " mm along the normal; the neighbours are " + NameSlices(beside));
  }
}

[[noreturn]] void
RefuseUnevenSteps(const std::vector<DicomSlice> & slices, const std::vector<double> & distances, double step)
{
  std::size_t worst = 1;
  const auto  getWidth = [&distances](std::size_t i) { return distances[i] - distances[i - 1]; };
  for (std::size_t i = 2; i < distances.size(); ++i)
  {
    worst = std::abs(getWidth(i) - step) > std::abs(getWidth(worst) - step) ? i : worst;
  }
  std::ostringstream text;
  text << "most slices are " << step << " mm apart, but " << NameSlices({ slices[worst - 1], slices[worst] }) << " are "
       << getWidth(worst) << " mm";
  Refuse(text.str());
}

void
CheckEvenlySpaced(const std::vector<DicomSlice> & slices, const std::vector<double> & distances, double step)
{
  const double spacing = (distances.back() - distances.front()) / static_cast<double>(distances.size() - 1);
  for (std::size_t i = 0; i < distances.size(); ++i)
  {
    const double place = distances.front() + static_cast<double>(i) * spacing;
    if (std::abs(distances[i] - place) > GetTolerance(spacing))
    {
      RefuseUnevenSteps(slices, distances, step);
    }
  }
}

void
CheckStraight(const std::vector<DicomSlice> & slices, const std::vector<double> & distances, double pixel)
{
  const auto   axes = GetSliceAxes(slices.front());
  const Vector first = GetPosition(slices.front());
  const double height = distances.back() - distances.front();
  const auto   getShift = [&](std::size_t i) {
    return Subtract(Subtract(GetPosition(slices[i]), first), axes[2], distances[i] - distances.front());
  };
  const Vector tilt = getShift(slices.size() - 1);
  for (std::size_t i = 0; i < slices.size(); ++i)
  {
    const double part = (distances[i] - distances.front()) / height;
    const double shift = GetLength(Subtract(getShift(i), tilt, part));
    if (shift > pixel / 10)
    {
      std::ostringstream text;
      text << NameSlices({ slices[i] }) << " is shifted sideways by " << shift << " mm";
      Refuse(text.str());
    }
  }
  if (GetLength(tilt) > pixel / 10)
  {
    std::ostringstream text;
    constexpr double   degrees = 57.29577951308232;
    text << "the slices are tilted by " << std::atan2(GetLength(tilt), height) * degrees
         << " degrees against the line of their positions (gantry tilt); resample them to upright slices first";
    Refuse(text.str());
  }
}
} // namespace

std::string
NameSlices(const std::vector<DicomSlice> & slices)
{
  std::vector<std::string> names;
  for (const DicomSlice & slice : slices)
  {
    names.push_back(NameSlice(slice));
  }
  return Join(names);
}

std::array<Vector, 3>
GetSliceAxes(const DicomSlice & slice)
{
  const auto orientation = slice.GetFrame().Orientation.value_or(std::array<double, 6>{ 1, 0, 0, 0, 1, 0 });
  const auto & [a, b, c, d, e, f] = orientation;
  const Vector     row = { a, b, c };
  const Vector     column = { d, e, f };
  constexpr double tolerance = 1e-3;
  if (!(std::abs(GetLength(row) - 1) < tolerance && std::abs(GetLength(column) - 1) < tolerance &&
        std::abs(Dot(row, column)) < tolerance))
  {
    throw std::runtime_error("the orientation in " + NameSlice(slice) +
                             " is not made of two unit vectors at right angles");
  }
  const Vector x = Subtract({}, row, -1 / GetLength(row));
  const Vector rest = Subtract(column, x, Dot(column, x));
  const Vector y = Subtract({}, rest, -1 / GetLength(rest));
  return { x, y, { x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0] } };
}

std::vector<DicomSlice>
ChoosePhase(std::vector<DicomSlice> slices, double pixel, const std::optional<unsigned int> & phase)
{
  const Vector normal = GetSliceAxes(slices.front())[2];
  std::stable_sort(slices.begin(), slices.end(), [&normal](const DicomSlice & a, const DicomSlice & b) {
    return Dot(GetPosition(a), normal) < Dot(GetPosition(b), normal);
  });
  auto              groups = GroupByPosition(slices, pixel);
  const std::size_t number = slices.size() / groups.size();
  if (groups.size() < slices.size())
  {
    CheckPhasesAreComplete(groups, pixel);
    if (!phase)
    {
      Refuse(std::to_string(number) + " images stand at each of its " + std::to_string(groups.size()) + " positions (" +
             NameSlices(groups.front()) + " at the first), as phases do; choose one with --frame, 0 to " +
             std::to_string(number - 1));
    }
  }
  if (phase.value_or(0) >= number)
  {
    throw std::runtime_error("there is no frame " + std::to_string(*phase) + "; at each position, it has " +
                             std::to_string(number) + ", counted from 0");
  }
  std::vector<DicomSlice> chosen;
  for (auto & images : groups)
  {
    if (!HaveOrder(images))
    {
      Refuse("nothing tells the images at one position apart: " + NameSlices(images));
    }
    chosen.push_back(images[phase.value_or(0)]);
  }
  return chosen;
}

double
CheckPositions(const std::vector<DicomSlice> & slices, double pixel)
{
  const std::vector<double> distances = GetDistances(slices);
  const double              step = GetUsualStep(distances);
  CheckNoSliceIsMissing(slices, distances, step);
  CheckEvenlySpaced(slices, distances, step);
  CheckStraight(slices, distances, pixel);
  return (distances.back() - distances.front()) / static_cast<double>(distances.size() - 1);
}
