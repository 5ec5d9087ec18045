// SPDX-License-Identifier: Apache-2.0
#include "VolumeReader.h"
#include "HeaderText.h"

namespace
{
/** The values that an option gives for the axes, in place of the file's. */
void
Override(const std::string &                        path,
         const char *                               what,
         const std::optional<std::vector<double>> & given,
         std::vector<double> &                      values,
         const WarningSink &                        warn)
{
  if (!given)
  {
    return;
  }
  const bool isOneForAll = given->size() == 1;
  if (!isOneForAll && given->size() != values.size())
  {
    FailToRead(path,
               std::string("it has ") + std::to_string(values.size()) + " axes, but " + std::to_string(given->size()) +
                 " values were given as its " + what);
  }
  const std::vector<double> meant = isOneForAll ? std::vector<double>(values.size(), given->front()) : *given;
  if (meant != values)
  {
    warn("the " + std::string(what) + " " + JoinReals(values) + " of " + path + " is overridden by " +
         JoinReals(meant));
  }
  values = meant;
}
} // namespace

void
VolumeReader::OverrideGrid(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  Override(path, "spacing", options.Spacing, m_Description.Grid.Spacing, warn);
  Override(path, "origin", options.Origin, m_Description.Grid.Origin, warn);
  CheckDescription(path, m_Description);
}
