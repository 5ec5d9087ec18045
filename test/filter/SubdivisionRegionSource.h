// SPDX-License-Identifier: Apache-2.0
#ifndef SubdivisionRegionSource_h
#define SubdivisionRegionSource_h

#include "itkImageRegionIteratorWithIndex.h"
#include "itkImageSource.h"

namespace SubdivisionTest
{

/** A source that generates and allocates exactly the region that is asked for. The value of a voxel depends on its
 * index alone, so that a filter downstream that asks for too little cannot pass. (ITK's own readers and filters often
 * deliver more than was asked, which hides such a mistake.) */
template <typename TImage>
class RegionSource : public itk::ImageSource<TImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(RegionSource);
  using Self = RegionSource;
  using Superclass = itk::ImageSource<TImage>;
  using Pointer = itk::SmartPointer<Self>;
  using RegionType = typename TImage::RegionType;
  using IndexType = typename TImage::IndexType;
  itkNewMacro(Self);

  void
  SetLargestRegion(const RegionType & region)
  {
    m_LargestRegion = region;
    this->Modified();
  }

protected:
  RegionSource() { this->DynamicMultiThreadingOn(); }

  void
  GenerateOutputInformation() override
  {
    this->GetOutput()->SetLargestPossibleRegion(m_LargestRegion);
  }

  void
  DynamicThreadedGenerateData(const RegionType & region) override
  {
    itk::ImageRegionIteratorWithIndex<TImage> it(this->GetOutput(), region);
    for (; !it.IsAtEnd(); ++it)
    {
      it.Set(static_cast<typename TImage::PixelType>(ValueAt(it.GetIndex())));
    }
  }

private:
  /** Flat blocks of three voxels with some noise in every second one, within 0 ... 1000. */
  static unsigned int
  ValueAt(const IndexType & index)
  {
    unsigned int block = 17;
    unsigned int voxel = 5;
    for (unsigned int w = 0; w < TImage::ImageDimension; ++w)
    {
      block = block * 31 + static_cast<unsigned int>((index[w] + 300) / 3);
      voxel = (voxel ^ static_cast<unsigned int>(index[w] + 300)) * 2654435761u;
    }
    return (block * 2654435761u >> 8) % 900 + (block % 2) * ((voxel >> 16) % 100);
  }

  RegionType m_LargestRegion;
};

} // namespace SubdivisionTest

#endif
