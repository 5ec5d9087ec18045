// SPDX-License-Identifier: Apache-2.0
#ifndef LevelChain_h
#define LevelChain_h

#include "Options.h"
#include "Pieces.h"
#include "system/process/PageBuffer.h"
#include "volumes/ImageDescription.h"

#include "NonOscillatorySubdivision/Subdivider.h"

#include <memory>
#include <vector>

/** What is computed of an image: its resolution doubled once for each level, with real values between levels, or labels
 * again where the voxels are labels. Boxes are those of the image, counted from its first voxel; the components of a
 * voxel lie side by side. */
class LevelChain
{
public:
  /** \throw std::runtime_error if the options do not fit such an image */
  LevelChain(const ImageDescription & input, const Options & options, unsigned int threads);

  /** All that is known of the output. */
  const ImageDescription &
  GetOutput() const
  {
    return m_Output;
  }

  Box
  GetWholeOutput() const;

  /** What must be read of the input for a part of the output. */
  Box
  GetRequest(const Box & piece) const;

  /** The voxels of the input of which the first child lies in a part of the output: disjoint parts of the output have
   * disjoint shares, and together they have all voxels. May be empty. */
  Box
  GetShare(const Box & piece) const;

  /** Bytes between the levels for a part of the output. */
  std::uint64_t
  GetScratchBytes(const Box & piece) const;

  /** Computes a part of the output from a box of the input that holds what the part needs. */
  void
  Compute(const Box &                     request,
          const void *                    input,
          const Box &                     piece,
          void *                          output,
          itk::Subdivision::TileMonitor & monitor);

private:
  /** What each level reads for a part of the output, the first level's first. */
  std::vector<Box>
  GetRequests(const Box & piece) const;

  /** The box with the axis of the components, if there is one, and back. */
  Box
  WithComponents(Box box) const;
  Box
  WithoutComponents(Box box) const;

  template <typename TView>
  TView
  MakeView(const Box & box, itk::Subdivision::ElementType type, decltype(TView::Data) data) const;

  /** What computes one level. */
  std::unique_ptr<itk::Subdivision::TileRun>
  MakeRun(const itk::Subdivision::ConstArrayView & input,
          const Box &                              whole,
          const itk::Subdivision::ArrayView &      output);

  unsigned int                  m_Threads;
  bool                          m_IsOfLabels;
  unsigned int                  m_Components;
  itk::Subdivision::ElementType m_Input;
  itk::Subdivision::ElementType m_BetweenType;
  itk::Subdivision::Options     m_Options;
  std::vector<Box>              m_Wholes; // with components: the input of each level, and the output
  ImageDescription              m_Output;
  std::vector<PageBuffer>       m_Between;
  itk::Subdivision::Workspace   m_Workspace;
};

#endif
