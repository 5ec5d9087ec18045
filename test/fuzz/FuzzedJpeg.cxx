// SPDX-License-Identifier: Apache-2.0
#include "FuzzedFiles.h"

#include "itk/JpegIntegrity.h"

#include <cstdio>
#include <vector>

#include <jpeglib.h> // needs <cstdio> before it

namespace
{
/** Pixels of the largest frame that a file's bytes may be the header of: JPEG allows four thousand million, which take
 * minutes to decode from nothing. */
std::uint64_t
GetMostPixels(const std::string & text)
{
  std::uint64_t most = 0;
  for (std::size_t i = 0; i + 8 < text.size(); ++i)
  {
    const auto marker = static_cast<unsigned char>(text[i + 1]);
    if (text[i] == '\xff' && marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
    {
      const auto get = [&](std::size_t place) { return static_cast<unsigned char>(text[i + place]); };
      most = std::max(most, (std::uint64_t{ get(5) } * 256 + get(6)) * (std::uint64_t{ get(7) } * 256 + get(8)));
    }
  }
  return most;
}

/** Decodes a file in which nothing is wrong, from memory.
 * \return how many of the bytes were needed */
std::size_t
Decode(const std::string & text)
{
  jpeg_decompress_struct decoder = {};
  jpeg_error_mgr         errors = {};
  decoder.err = jpeg_std_error(&errors);
  errors.error_exit = [](j_common_ptr) { FuzzExpect(false, "a JPEG file that is called whole cannot be decoded"); };
  errors.emit_message = [](j_common_ptr, const int level) {
    FuzzExpect(level >= 0, "a JPEG file that is called whole is damaged");
  };
  jpeg_create_decompress(&decoder);
  jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char *>(text.data()), text.size());
  jpeg_read_header(&decoder, TRUE);
  jpeg_start_decompress(&decoder);
  FuzzExpect(GetMostPixels(text) >= std::uint64_t{ decoder.output_width } * decoder.output_height,
             "a JPEG file of more pixels than any of its headers says");
  std::vector<unsigned char> row(std::size_t{ decoder.output_width } *
                                 static_cast<std::size_t>(decoder.output_components));
  unsigned int               rows = 0;
  for (JSAMPROW start = row.data(); decoder.output_scanline < decoder.output_height;)
  {
    rows += jpeg_read_scanlines(&decoder, &start, 1);
  }
  FuzzExpect(rows == decoder.image_height, "a JPEG file of fewer rows than its header says");
  jpeg_finish_decompress(&decoder);
  const std::size_t left = decoder.src->bytes_in_buffer;
  jpeg_destroy_decompress(&decoder);
  return text.size() - left;
}
} // namespace

/** What is called whole can be decoded, and is not called so if it ends earlier. */
void
FuzzJpeg(FuzzBytes & bytes, const FuzzFolder & folder)
{
  const std::uint64_t place = bytes.UpTo(0xffff);
  const std::string   text = bytes.Rest();
  if (GetMostPixels(text) > 1 << 18)
  {
    return;
  }
  const bool isWhole = FindJpegFault(folder.Write("whole.jpg", text)).empty();
  if (isWhole && text.compare(0, 2, "\xff\xd8") == 0)
  {
    const std::size_t needed = Decode(text);
    const std::string cut = text.substr(0, 2 + place % (needed - 2));
    FuzzExpect(!FindJpegFault(folder.Write("cut.jpg", cut)).empty(), "a JPEG file that is cut is called whole");
  }
}
