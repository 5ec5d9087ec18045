// SPDX-License-Identifier: Apache-2.0
#include "itk/ItkNrrdReader.h"
#include "headers/NrrdHeader.h"
#include "text/HeaderText.h"

ItkNrrdReader::ItkNrrdReader(const std::string & path)
  : ItkReader(path, "NRRD")
{
  try
  {
    ImageDescription told = DescribeNrrd(path);
    if (told.Grid.Size != m_Description.Grid.Size || told.NumberOfComponents != m_Description.NumberOfComponents)
    {
      FailToRead(path, "the order of its axes is not clear; save its voxels with the components as the first axis");
    }
    m_Description.Grid = told.Grid;
    m_Description.Metadata = told.Metadata;
  }
  catch (const HeaderNotUnderstood &)
  {
    ReplaceNrrdMetadata(path, m_Description);
  }
}
