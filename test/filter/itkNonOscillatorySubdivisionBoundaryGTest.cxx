// SPDX-License-Identifier: Apache-2.0
// Boundary conditions: those that the filter knows are taken by their exact class, all others are asked; one that does
// not fit the pixels is refused before anything runs; null stands for the default.

#include "SubdivisionCommonFilters.h"

#include <atomic>
#include <stdexcept>

using namespace SubdivisionTest;

namespace
{

/** A boundary condition derived from another one, that supplies ten times the value of its base. */
template <typename TBase>
class TenTimes : public TBase
{
public:
  using Image = typename TBase::RegionType;
  using typename TBase::IndexType;
  using typename TBase::OutputPixelType;

  OutputPixelType
  GetPixel(const IndexType & index, const DoubleImage * image) const override
  {
    const bool isInside = image->GetLargestPossibleRegion().IsInside(index);
    return (isInside ? 1.0 : 10.0) * TBase::GetPixel(index, image);
  }
};

/** What the filter makes of an image, computed from an image that was continued by a boundary condition beforehand. */
DoubleImage::Pointer
SubdividedWithMargin(const DoubleImage * input, const itk::ImageBoundaryCondition<DoubleImage> & condition)
{
  constexpr long margin = 6;
  auto           region = input->GetLargestPossibleRegion();
  region.PadByRadius(margin);
  const auto padded =
    ImageOf<DoubleImage>(region, [&](const auto & index) { return condition.GetPixel(index, input); });
  auto filter = DoubleFilter::New();
  filter->SetInput(padded);
  auto part = input->GetLargestPossibleRegion();
  for (unsigned int w = 0; w < 3; ++w)
  {
    part.SetIndex(w, 2 * part.GetIndex(w));
    part.SetSize(w, 2 * part.GetSize(w));
  }
  filter->GetOutput()->SetRequestedRegion(part);
  filter->Update();
  DoubleImage::Pointer output = filter->GetOutput();
  output->DisconnectPipeline();
  return output;
}

DoubleImage::Pointer
SomeVolume()
{
  const auto image = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ -3, 4, 7 }, { 9, 6, 5 }));
  FillWithTestData(image.GetPointer(), 1.0, 2.0, 0);
  return image;
}

template <typename TBase>
void
ExpectAsked()
{
  const auto            input = SomeVolume();
  const TenTimes<TBase> condition;
  const auto            expected = SubdividedWithMargin(input.GetPointer(), condition);

  TenTimes<TBase> borrowed;
  auto            filter = DoubleFilter::New();
  filter->SetBoundaryCondition(&borrowed);
  const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
  EXPECT_TRUE(SameBytes(output.GetPointer(), expected.GetPointer()));
}

/** Remembers what it is asked for. */
class Recorder : public itk::ZeroFluxNeumannBoundaryCondition<DoubleImage>
{
public:
  RegionType
  GetInputRequestedRegion(const RegionType & whole, const RegionType & stencil) const override
  {
    m_Whole = whole;
    m_Stencil = stencil;
    return itk::ZeroFluxNeumannBoundaryCondition<DoubleImage>::GetInputRequestedRegion(whole, stencil);
  }

  mutable RegionType m_Whole;
  mutable RegionType m_Stencil;
};

/** Throws where it is asked. */
class Thrower : public itk::ZeroFluxNeumannBoundaryCondition<DoubleImage>
{
public:
  double
  GetPixel(const IndexType &, const DoubleImage *) const override
  {
    ++m_Asked;
    throw std::runtime_error("no pixel outside");
  }

  mutable std::atomic<int> m_Asked{ 0 };
};

using Vectors = itk::VectorImage<float, 2>;
using VectorsFilter = itk::NonOscillatorySubdivisionImageFilter<Vectors>;

Vectors::Pointer
SomeVectors()
{
  const auto image = MakeImage<Vectors>(MakeRegion<Vectors>({ 0, 0 }, { 6, 5 }), 3);
  FillWithTestData(image.GetPointer(), 0.0, 1.0, 0);
  return image;
}

std::string
ErrorWithConstant(const unsigned int components)
{
  itk::ConstantBoundaryCondition<Vectors> condition;
  if (components > 0)
  {
    itk::VariableLengthVector<float> constant(components);
    constant.Fill(2.0f);
    condition.SetConstant(constant);
  }
  auto filter = VectorsFilter::New();
  filter->SetBoundaryCondition(&condition);
  filter->SetInput(SomeVectors());
  bool hasStarted = false;
  filter->AddObserver(itk::StartEvent(), [&](const itk::EventObject &) { hasStarted = true; });
  try
  {
    filter->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_FALSE(hasStarted);
    return error.GetDescription();
  }
  return {};
}

} // namespace

TEST(NonOscillatorySubdivisionBoundary, DerivedClassesAreAsked)
{
  ExpectAsked<itk::ZeroFluxNeumannBoundaryCondition<DoubleImage>>();
  ExpectAsked<itk::MirrorBoundaryCondition<DoubleImage>>();
  ExpectAsked<itk::PeriodicBoundaryCondition<DoubleImage>>();
  ExpectAsked<itk::ConstantBoundaryCondition<DoubleImage>>();
}

TEST(NonOscillatorySubdivisionBoundary, KnownClassesDoAsTheySay)
{
  const auto                      input = SomeVolume();
  BoundaryConditions<DoubleImage> boundaries;
  boundaries.constant.SetConstant(0.75);
  for (const BoundaryKind kind : AllBoundaries())
  {
    auto filter = DoubleFilter::New();
    filter->SetBoundaryCondition(boundaries.Get(kind));
    const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
    const auto expected = SubdividedWithMargin(input.GetPointer(), *boundaries.Get(kind));
    EXPECT_TRUE(SameBytes(output.GetPointer(), expected.GetPointer())) << NameOf(kind);
  }
}

/** A condition that the filter does not know is asked about the image as it lies. */
TEST(NonOscillatorySubdivisionBoundary, UnknownOnesAreAskedForTheirRequest)
{
  Recorder   recorder;
  const auto input = SomeVolume();
  auto       filter = DoubleFilter::New();
  filter->SetBoundaryCondition(&recorder);
  filter->SetInput(input);
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegion(MakeRegion<DoubleImage>({ -6, 8, 14 }, { 2, 2, 2 }));
  filter->Update();
  EXPECT_EQ(recorder.m_Whole, input->GetLargestPossibleRegion());
  EXPECT_EQ(recorder.m_Stencil, MakeRegion<DoubleImage>({ -8, -1, 2 }, { 11, 11, 11 }));
}

TEST(NonOscillatorySubdivisionBoundary, NullIsTheDefault)
{
  const auto                                  input = SomeVolume();
  itk::PeriodicBoundaryCondition<DoubleImage> periodic;
  auto                                        filter = DoubleFilter::New();
  const auto * const                          standard = filter->GetBoundaryCondition();
  const auto                                  expected = RunFilter(filter.GetPointer(), input.GetPointer());

  filter->SetBoundaryCondition(&periodic);
  const auto other = RunFilter(filter.GetPointer(), input.GetPointer());
  EXPECT_FALSE(SameBytes(other.GetPointer(), expected.GetPointer()));

  filter->SetBoundaryCondition(nullptr);
  EXPECT_EQ(filter->GetBoundaryCondition(), standard);
  EXPECT_TRUE(SameBytes(RunFilter(filter.GetPointer(), input.GetPointer()).GetPointer(), expected.GetPointer()));

  filter->SetBoundaryCondition(&periodic);
  const auto time = filter->GetMTime();
  filter->SetBoundaryConditionToDefault();
  EXPECT_EQ(filter->GetBoundaryCondition(), standard);
  EXPECT_GT(filter->GetMTime(), time);
  EXPECT_TRUE(SameBytes(RunFilter(filter.GetPointer(), input.GetPointer()).GetPointer(), expected.GetPointer()));
}

TEST(NonOscillatorySubdivisionBoundary, ConstantsFitThePixels)
{
  for (const unsigned int components : { 0u, 1u, 2u, 4u })
  {
    const std::string error = ErrorWithConstant(components);
    EXPECT_NE(error.find(std::to_string(components) + " components"), std::string::npos) << error;
    EXPECT_NE(error.find("must have 3"), std::string::npos) << error;
  }
  EXPECT_EQ(ErrorWithConstant(3), "");
}

/** Each component of the constant goes with that of the pixels. */
TEST(NonOscillatorySubdivisionBoundary, ConstantsOfComponents)
{
  const auto                       vectors = SomeVectors();
  itk::VariableLengthVector<float> constant(3);
  using Plane = itk::Image<float, 2>;
  itk::ConstantBoundaryCondition<Vectors> condition;
  for (unsigned int c = 0; c < 3; ++c)
  {
    constant[c] = 0.25f + 3.0f * static_cast<float>(c);
  }
  condition.SetConstant(constant);
  auto filter = VectorsFilter::New();
  filter->SetBoundaryCondition(&condition);
  const auto output = RunFilter(filter.GetPointer(), vectors.GetPointer());
  for (unsigned int c = 0; c < 3; ++c)
  {
    itk::ConstantBoundaryCondition<Plane> one;
    one.SetConstant(constant[c]);
    auto alone = itk::NonOscillatorySubdivisionImageFilter<Plane>::New();
    alone->SetBoundaryCondition(&one);
    const auto plane = ImageOf<Plane>(vectors->GetLargestPossibleRegion(),
                                      [&](const auto & index) { return vectors->GetPixel(index)[c]; });
    const auto expected = RunFilter(alone.GetPointer(), plane.GetPointer());
    for (std::size_t i = 0; i < CountScalars(expected.GetPointer()); ++i)
    {
      ASSERT_EQ(ScalarsOf(output.GetPointer())[3 * i + c], ScalarsOf(expected.GetPointer())[i]) << i << ", " << c;
    }
  }
}

/** What a boundary condition throws comes out of the update, and the filter can be used again. */
TEST(NonOscillatorySubdivisionBoundary, Throws)
{
  const auto input = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, { 70, 60, 50 }));
  FillWithTestData(input.GetPointer(), 0.0, 1.0, 0);
  auto       filter = DoubleFilter::New();
  const auto expected = RunFilter(filter.GetPointer(), input.GetPointer());
  Thrower    thrower;
  for (const unsigned int units : { 1u, 4u, 64u })
  {
    thrower.m_Asked = 0;
    filter->SetNumberOfWorkUnits(units);
    filter->SetBoundaryCondition(&thrower);
    filter->SetInput(input);
    EXPECT_THROW(filter->UpdateLargestPossibleRegion(), std::runtime_error);
    EXPECT_GE(thrower.m_Asked, 1);
    // Each thread stops at its first exception or before its next tile.
    EXPECT_LE(thrower.m_Asked, static_cast<int>(units));
    filter->SetBoundaryConditionToDefault();
    EXPECT_TRUE(SameBytes(RunFilter(filter.GetPointer(), input.GetPointer()).GetPointer(), expected.GetPointer()));
  }
}
