// SPDX-License-Identifier: Apache-2.0

// What holds of the filter in any pipeline, on generated ones: geometry, agreement with the slow reference, and the
// same bytes whatever region is asked for, however it is streamed and however many work units share it.

#include "common/GeneratedCases.h"
#include "SubdivisionRandomCases.h"

#include "NonOscillatorySubdivision/Target.h"

#include "itkRGBPixel.h"
#include "itkStreamingImageFilter.h"
#include "itkVector.h"

using namespace SubdivisionTest;

namespace
{

/** Whether a part of an image that was computed alone has the bytes of the whole, for pixels of any type. */
template <typename TImage>
testing::AssertionResult
HasBytesOfWhole(const TImage * const part, const TImage * const whole)
{
  const std::size_t                              components = whole->GetNumberOfComponentsPerPixel();
  itk::ImageRegionConstIteratorWithIndex<TImage> it(part, part->GetRequestedRegion());
  using Scalar = std::remove_const_t<std::remove_reference_t<decltype(*ScalarsOf(whole))>>;
  for (; !it.IsAtEnd(); ++it)
  {
    const auto * const a = ScalarsOf(part) + part->ComputeOffset(it.GetIndex()) * components;
    const auto * const b = ScalarsOf(whole) + whole->ComputeOffset(it.GetIndex()) * components;
    if (std::memcmp(a, b, components * sizeof(Scalar)) != 0)
    {
      return testing::AssertionFailure() << it.GetIndex() << " differs: " << +*a << ", in the whole " << +*b;
    }
  }
  return testing::AssertionSuccess();
}

/** A matrix whose columns are orthonormal, of any handedness. */
template <unsigned int D>
itk::Matrix<double, D, D>
MakeDirection(std::mt19937 & engine)
{
  std::normal_distribution<double> normal;
  itk::Matrix<double, D, D>        direction;
  for (unsigned int column = 0; column < D; ++column)
  {
    itk::Vector<double, D> vector;
    do
    {
      for (unsigned int row = 0; row < D; ++row)
      {
        vector[row] = normal(engine);
      }
      for (unsigned int before = 0; before < column; ++before)
      {
        double product = 0.0;
        for (unsigned int row = 0; row < D; ++row)
        {
          product += vector[row] * direction[row][before];
        }
        for (unsigned int row = 0; row < D; ++row)
        {
          vector[row] -= product * direction[row][before];
        }
      }
    } while (vector.GetNorm() < 0.1);
    for (unsigned int row = 0; row < D; ++row)
    {
      direction[row][column] = vector[row] / vector.GetNorm();
    }
  }
  return direction;
}

/** One generated pipeline. */
template <typename TImage>
class Pipeline
{
public:
  static constexpr unsigned int D = TImage::ImageDimension;
  using Scalar = ScalarOf<TImage>;
  using FilterType = itk::NonOscillatorySubdivisionImageFilter<TImage>;

  Pipeline(const unsigned int seed, const unsigned int components)
    : m_Engine(seed)
    , m_Low(std::is_unsigned<Scalar>::value ? 0.0 : -100.0)
    , m_Case(m_Engine, m_Low, 100.0)
    , m_Components(components)
  {
    m_Image = MakeImage<TImage>(MakeRegion<TImage>(m_Case.start, m_Case.size), components);
    FillWithTestData(m_Image.GetPointer(), m_Low, 100.0, static_cast<unsigned int>(m_Engine()));
    typename TImage::SpacingType spacing;
    typename TImage::PointType   origin;
    for (unsigned int axis = 0; axis < D; ++axis)
    {
      spacing[axis] = 0.05 + static_cast<double>(this->Below(300)) / 100.0;
      origin[axis] = static_cast<double>(this->Below(2001)) - 1000.0;
    }
    m_Image->SetSpacing(spacing);
    m_Image->SetOrigin(origin);
    m_Image->SetDirection(MakeDirection<D>(m_Engine));
    m_Boundaries.constant.SetConstant(UniformPixel<TImage>(components, m_Case.constant));
    const auto targets = itk::Subdivision::Target::GetNames();
    m_Target = targets[this->Below(targets.size())];
  }

  std::string
  Describe() const
  {
    return m_Case.Description() + ", target " + m_Target + ", " + std::to_string(m_Components) + " components of " +
           itk::Subdivision::GetName(itk::Subdivision::ElementTypeOf<Scalar>());
  }

  void
  Check()
  {
    const auto                     filter = this->MakeFilter();
    const typename TImage::Pointer whole = RunFilter(filter.GetPointer(), m_Image.GetPointer());
    this->ExpectGeometry(whole);
    this->ExpectRegion(whole);
    this->ExpectStreamed(whole);
    this->ExpectReference(whole);
  }

private:
  unsigned int
  Below(const std::size_t number)
  {
    return static_cast<unsigned int>(m_Engine() % number);
  }

  typename FilterType::Pointer
  MakeFilter()
  {
    auto filter = FilterType::New();
    filter->SetInput(m_Image);
    filter->SetScheme(m_Case.scheme);
    filter->SetTension(m_Case.tension);
    filter->SetBoundaryCondition(m_Boundaries.Get(m_Case.boundary));
    filter->SetTarget(m_Target);
    filter->SetNumberOfWorkUnits(1 + this->Below(9));
    SetAxes(filter.GetPointer(), m_Case.axes);
    return filter;
  }

  /** Sizes, first indices, and that every child lies a quarter of a voxel from the centre of its parent. */
  void
  ExpectGeometry(const TImage * const whole)
  {
    typename TImage::IndexType      child;
    itk::ContinuousIndex<double, D> place;
    for (unsigned int axis = 0; axis < D; ++axis)
    {
      const long factor = m_Case.axes[axis] ? 2 : 1;
      ASSERT_EQ(whole->GetLargestPossibleRegion().GetIndex(axis), factor * m_Case.start[axis]);
      ASSERT_EQ(static_cast<long>(whole->GetLargestPossibleRegion().GetSize(axis)), factor * m_Case.size[axis]);
      const long parent = m_Case.start[axis] + static_cast<long>(this->Below(m_Case.size[axis]));
      const long upper = m_Case.axes[axis] ? this->Below(2) : 0;
      child[axis] = factor * parent + upper;
      place[axis] = static_cast<double>(parent) + (m_Case.axes[axis] ? (upper == 1 ? 0.25 : -0.25) : 0.0);
    }
    typename TImage::PointType expected;
    typename TImage::PointType point;
    m_Image->TransformContinuousIndexToPhysicalPoint(place, expected);
    whole->TransformIndexToPhysicalPoint(child, point);
    EXPECT_LT(expected.EuclideanDistanceTo(point), 1e-10) << child;
  }

  void
  ExpectRegion(const TImage * const whole)
  {
    const auto filter = this->MakeFilter();
    const auto region = RandomSubRegion(whole->GetLargestPossibleRegion(), m_Engine);
    filter->UpdateOutputInformation();
    filter->GetOutput()->SetRequestedRegion(region);
    filter->Update();
    EXPECT_TRUE(HasBytesOfWhole<TImage>(filter->GetOutput(), whole)) << region;
  }

  void
  ExpectStreamed(const TImage * const whole)
  {
    const auto filter = this->MakeFilter();
    auto       streamer = itk::StreamingImageFilter<TImage, TImage>::New();
    streamer->SetInput(filter->GetOutput());
    streamer->SetNumberOfStreamDivisions(1 + this->Below(12));
    streamer->Update();
    EXPECT_TRUE(HasBytesOfWhole<TImage>(streamer->GetOutput(), whole))
      << streamer->GetNumberOfStreamDivisions() << " divisions";
  }

  void
  ExpectReference(const TImage * const whole)
  {
    constexpr std::size_t most = D > 3 ? 12 : D > 2 ? 50 : 150;
    if (m_Image->GetBufferedRegion().GetNumberOfPixels() > most)
    {
      return; // The slow reference would take longer than all else.
    }
    const unsigned int        component = this->Below(m_Components);
    const double              allowed = AllowedDifference<Scalar, Scalar>(100.0);
    const ref::Subdivision<D> reference(ToGrid(m_Image.GetPointer(), component), m_Case.ReferenceSettings());
    for (int i = 0; i < 40; ++i)
    {
      const std::size_t child = this->Below(whole->GetBufferedRegion().GetNumberOfPixels());
      const auto        index = whole->ComputeIndex(static_cast<itk::OffsetValueType>(child));
      ref::Index<D>     m;
      for (unsigned int axis = 0; axis < D; ++axis)
      {
        m[axis] = index[axis] - whole->GetBufferedRegion().GetIndex(axis);
      }
      ASSERT_TRUE(IsConversionOf(ScalarsOf(whole)[child * m_Components + component], reference.At(m), allowed))
        << "child " << index << ", component " << component;
    }
  }

  std::mt19937               m_Engine;
  double                     m_Low;
  RandomCase<D>              m_Case;
  unsigned int               m_Components;
  typename TImage::Pointer   m_Image;
  BoundaryConditions<TImage> m_Boundaries;
  std::string                m_Target;
};

template <typename TImage>
void
ExpectProperties(const unsigned int components = 1)
{
  ForEachGeneratedCase(120, [components](const unsigned int seed) {
    Pipeline<TImage> pipeline(seed, components);
    SCOPED_TRACE(pipeline.Describe());
    pipeline.Check();
  });
}

} // namespace

TEST(NonOscillatorySubdivisionProperties, OneDimension)
{
  ExpectProperties<itk::Image<std::uint64_t, 1>>();
  ExpectProperties<itk::Image<itk::Vector<float, 3>, 1>>(3);
}

TEST(NonOscillatorySubdivisionProperties, TwoDimensions)
{
  ExpectProperties<itk::Image<float, 2>>();
  ExpectProperties<itk::Image<std::int8_t, 2>>();
  ExpectProperties<itk::Image<std::int32_t, 2>>();
  ExpectProperties<itk::Image<itk::RGBPixel<std::uint8_t>, 2>>(3);
}

TEST(NonOscillatorySubdivisionProperties, ThreeDimensions)
{
  ExpectProperties<itk::Image<std::uint8_t, 3>>();
  ExpectProperties<itk::Image<std::int16_t, 3>>();
  ExpectProperties<itk::Image<double, 3>>();
  ExpectProperties<itk::VectorImage<std::uint32_t, 3>>(2);
}

TEST(NonOscillatorySubdivisionProperties, FourDimensions)
{
  ExpectProperties<itk::Image<std::uint16_t, 4>>();
  ExpectProperties<itk::VectorImage<float, 4>>(4);
  ExpectProperties<itk::Image<std::int64_t, 4>>();
}
