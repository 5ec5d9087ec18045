// SPDX-License-Identifier: Apache-2.0
#ifndef Bitmap_h
#define Bitmap_h

#include "itkImageIOBase.h"

#include <string>

/** ITK's reader of a BMP file, which has read its header. It makes colours of every colour table unless it is told not
 * to, also of that of grey values.
 * \throw itk::ExceptionObject */
itk::ImageIOBase::Pointer
OpenBitmap(const std::string & path);

#endif
