// SPDX-License-Identifier: Apache-2.0
#include "itk/LibraryReason.h"
#include "text/OneLineMessage.h"

#include "itkMacro.h"

#include <regex>

std::string
GetReason(const std::exception & error, const std::string & path)
{
  const auto * const itkError = dynamic_cast<const itk::ExceptionObject *>(&error);
  std::string        text = MakeOneLine(itkError != nullptr ? itkError->GetDescription() : error.what());
  // Which function of which object failed.
  static const std::regex place("^(ITK ERROR: |itk::ERROR: )?(\\w+\\((0x)?[0-9a-fA-F]+\\): )?(Read\\w*: )?");
  text = std::regex_replace(text, place, "");
  // NRRD's library tells of each function that the error came through; the last one knows the reason.
  static const std::regex chain("^.*\\[nrrd\\] \\w+: ");
  text = std::regex_replace(text, chain, "");
  if (text.find("UNKNOWNCOMPONENTTYPE") != std::string::npos)
  {
    return "its voxels are of a type that is not supported";
  }
  const bool startsWithPath = !path.empty() && text.rfind(path + ' ', 0) == 0;
  return startsWithPath ? "it" + text.substr(path.size()) : text;
}
