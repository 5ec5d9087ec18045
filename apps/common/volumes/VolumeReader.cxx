// SPDX-License-Identifier: Apache-2.0
#include "volumes/VolumeReader.h"
#include "volumes/DescriptionCheck.h"
#include "volumes/GridOverrides.h"

void
VolumeReader::OverrideGrid(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  ApplyOverrides(m_Description, options, warn);
  CheckDescription(path, m_Description);
}
