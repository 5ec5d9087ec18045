// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffHandle.h"
#include "text/OneLineMessage.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace
{
std::string
Format(const char * format, va_list arguments)
{
  std::array<char, 500> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  return MakeOneLine(text.data());
}
} // namespace

TiffHandle::TiffHandle(const std::string & path, const std::string & mode, const std::string & meant)
  : m_Meant(meant)
  , m_IsForWriting(mode.front() == 'w')
{
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions *)> options(TIFFOpenOptionsAlloc(),
                                                                              TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), TakeError, this);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), TakeWarning, this);
  m_Tiff = TIFFOpenExt(path.c_str(), mode.c_str(), options.get());
  if (m_Tiff == nullptr)
  {
    this->Fail(m_IsForWriting ? "it cannot be created" : "it is no TIFF file, or it is damaged");
  }
}

TiffHandle::~TiffHandle()
{
  if (m_Tiff != nullptr)
  {
    TIFFClose(m_Tiff);
  }
}

void
TiffHandle::Fail(const std::string & reason) const
{
  throw std::runtime_error((m_IsForWriting ? "cannot write " : "cannot read ") + m_Meant + ": " + reason +
                           (m_Error.empty() ? "" : " (" + m_Error + ")"));
}

int
TiffHandle::TakeError(TIFF *, void * self, const char *, const char * format, va_list arguments)
{
  auto & error = static_cast<TiffHandle *>(self)->m_Error;
  if (error.empty())
  {
    error = Format(format, arguments);
  }
  return 1;
}

int
TiffHandle::TakeWarning(TIFF *, void * self, const char *, const char * format, va_list arguments)
{
  auto &            warnings = static_cast<TiffHandle *>(self)->m_Warnings;
  const std::string warning = Format(format, arguments);
  if (warning.find("Unknown field with tag") == std::string::npos &&
      std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
  {
    warnings.push_back(warning);
  }
  return 1;
}
