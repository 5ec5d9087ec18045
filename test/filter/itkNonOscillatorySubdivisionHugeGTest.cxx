// SPDX-License-Identifier: Apache-2.0

// Outputs of more voxels than 32 bits count, of which parts are asked for: those at the far end are those of the same
// data near index 0.

#include "SubdivisionTestHelpers.h"

#include "itkImageSource.h"

using namespace SubdivisionTest;

namespace
{

using ByteVolume = itk::Image<unsigned char, 3>;

/** Generates what is asked for of a volume that repeats itself after some voxels along each axis. */
class PatternSource : public itk::ImageSource<ByteVolume>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(PatternSource);
  using Self = PatternSource;
  using Superclass = itk::ImageSource<ByteVolume>;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  static constexpr long Period = 24;

  void
  SetSize(const ref::Index<3> & size)
  {
    m_Size = size;
    this->Modified();
  }

protected:
  PatternSource() = default;

  void
  GenerateOutputInformation() override
  {
    this->GetOutput()->SetLargestPossibleRegion(MakeRegion<ByteVolume>({ 0, 0, 0 }, m_Size));
  }

  void
  GenerateData() override
  {
    this->AllocateOutputs();
    itk::ImageRegionIteratorWithIndex<ByteVolume> it(this->GetOutput(), this->GetOutput()->GetRequestedRegion());
    for (; !it.IsAtEnd(); ++it)
    {
      const auto index = it.GetIndex();
      it.Set(
        static_cast<unsigned char>((index[0] % Period * 31 + index[1] % Period * 57 + index[2] % Period * 83) % 251));
    }
  }

private:
  ref::Index<3> m_Size{};
};

/** A part of the output of a volume of the given size. */
ByteVolume::Pointer
ComputePart(const ref::Index<3> & size, const SchemeEnum scheme, const ByteVolume::RegionType & region)
{
  auto source = PatternSource::New();
  source->SetSize(size);
  auto filter = itk::NonOscillatorySubdivisionImageFilter<ByteVolume>::New();
  filter->SetInput(source->GetOutput());
  filter->SetScheme(scheme);
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegion(region);
  filter->Update();
  ByteVolume::Pointer part = filter->GetOutput();
  part->DisconnectPipeline();
  return part;
}

/** The last voxels along every axis, the last of all among them, against those of a volume that is some periods long.
 */
void
ExpectFarEndAsNearOne(const ref::Index<3> & periods, const SchemeEnum scheme)
{
  constexpr long period = PatternSource::Period;
  ref::Index<3>  farSize;
  ref::Index<3>  nearSize;
  ref::Index<3>  farStart;
  ref::Index<3>  nearStart;
  ref::Index<3>  partSize;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const long rest = 7 + axis;
    farSize[axis] = periods[axis] * period + rest;
    nearSize[axis] = std::min(periods[axis], 2L) * period + rest;
    partSize[axis] = 33;
    farStart[axis] = 2 * farSize[axis] - partSize[axis];
    nearStart[axis] = 2 * nearSize[axis] - partSize[axis];
  }
  const double voxels =
    8.0 * static_cast<double>(farSize[0]) * static_cast<double>(farSize[1]) * static_cast<double>(farSize[2]);
  ASSERT_GT(voxels, 2147483648.0);
  const auto        farPart = ComputePart(farSize, scheme, MakeRegion<ByteVolume>(farStart, partSize));
  const auto        nearPart = ComputePart(nearSize, scheme, MakeRegion<ByteVolume>(nearStart, partSize));
  const std::size_t count = CountScalars(nearPart.GetPointer());
  ASSERT_EQ(CountScalars(farPart.GetPointer()), count);
  EXPECT_EQ(std::memcmp(ScalarsOf(farPart.GetPointer()), ScalarsOf(nearPart.GetPointer()), count), 0) << scheme;
}

} // namespace

TEST(NonOscillatorySubdivisionHuge, FarEndOfMoreThanTwoToThe31Voxels)
{
  for (const SchemeEnum scheme : AllSchemes())
  {
    ExpectFarEndAsNearOne({ 1300, 1700, 1 }, scheme);
    ExpectFarEndAsNearOne({ 80, 90, 70 }, scheme);
    ExpectFarEndAsNearOne({ 1, 1, 4000000 }, scheme);
  }
}

/** Rows of which a single one, and planes of which a single one, have more than 2^31 voxels: indices beyond 32 bits. */
TEST(NonOscillatorySubdivisionHuge, IndicesBeyond32Bits)
{
  ExpectFarEndAsNearOne({ 200000000, 1, 1 }, SchemeEnum::NonOscillatory);
  ExpectFarEndAsNearOne({ 1, 200000000, 200000000 }, SchemeEnum::Restored);
}
