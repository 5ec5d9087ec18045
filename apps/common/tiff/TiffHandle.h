// SPDX-License-Identifier: Apache-2.0
#ifndef TiffHandle_h
#define TiffHandle_h

#include <cstdint>
#include <string>
#include <tiffio.h>
#include <vector>

/** A TIFF file that libtiff has open, and what it said. */
class TiffHandle
{
public:
  /** \param mode as TIFFOpen() has it
   * \param meant the name that messages call the file by
   * \throw std::runtime_error */
  TiffHandle(const std::string & path, const std::string & mode, const std::string & meant);
  ~TiffHandle();
  TiffHandle(const TiffHandle &) = delete;
  TiffHandle &
  operator=(const TiffHandle &) = delete;

  operator TIFF *() const { return m_Tiff; }

  const std::string &
  GetName() const
  {
    return m_Meant;
  }

  /** \throw std::runtime_error with a reason and, in brackets, the first error that libtiff told of, if any */
  [[noreturn]] void
  Fail(const std::string & reason) const;

  /** Warnings of libtiff, each once, but those of tags that it does not know. */
  const std::vector<std::string> &
  GetWarnings() const
  {
    return m_Warnings;
  }

private:
  static int
  TakeError(TIFF * tiff, void * self, const char * module, const char * format, va_list arguments);
  static int
  TakeWarning(TIFF * tiff, void * self, const char * module, const char * format, va_list arguments);

  std::string              m_Meant;
  bool                     m_IsForWriting;
  std::string              m_Error;
  std::vector<std::string> m_Warnings;
  TIFF *                   m_Tiff = nullptr;
};

#endif
