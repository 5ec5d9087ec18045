// SPDX-License-Identifier: Apache-2.0
#include "itk/JpegIntegrity.h"

#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

// They need <cstdio> before them.
#include <jpeglib.h>

#include <jerror.h>

namespace
{
/** What the library tells of errors, which it must not return from, and of warnings. */
struct ErrorManager
{
  jpeg_error_mgr Base; // first: the library knows this part
  std::jmp_buf   End;
  char           Text[JMSG_LENGTH_MAX];
};

[[noreturn]] void
EndWithError(j_common_ptr decoder)
{
  auto * const errors = reinterpret_cast<ErrorManager *>(decoder->err);
  decoder->err->format_message(decoder, errors->Text);
  std::longjmp(errors->End, 1);
}

void
HandleMessage(j_common_ptr decoder, int level)
{
  if (level < 0) // a warning of damaged data, which the library would fill up with grey
  {
    EndWithError(decoder);
  }
}

/** Whether a file has fewer bits than its header says blocks of 8 x 8 pixels, each of which has a bit at least (but in
 * arithmetic coding). Of a progressive file, the library would first make room for all of them, up to some 25 GB. */
bool
LacksBlocks(const jpeg_decompress_struct & decoder, const std::uint64_t bytes)
{
  const std::uint64_t blocks = std::uint64_t{ decoder.image_width / 8 } * (decoder.image_height / 8);
  return decoder.arith_code == FALSE && blocks > 8 * bytes;
}

/** Nothing with a destructor may live here, where an error jumps out of. */
void
Decode(jpeg_decompress_struct &     decoder,
       std::FILE * const            file,
       const std::uint64_t          bytes,
       std::vector<unsigned char> & row)
{
  jpeg_stdio_src(&decoder, file);
  jpeg_read_header(&decoder, TRUE);
  if (LacksBlocks(decoder, bytes))
  {
    ERREXIT(&decoder, JERR_INPUT_EOF);
  }
  jpeg_start_decompress(&decoder);
  row.resize(std::size_t{ decoder.output_width } * static_cast<std::size_t>(decoder.output_components));
  while (decoder.output_scanline < decoder.output_height)
  {
    unsigned char * const start = row.data();
    JSAMPROW              rows[] = { start };
    jpeg_read_scanlines(&decoder, rows, 1);
  }
  jpeg_finish_decompress(&decoder);
}
} // namespace

std::string
FindJpegFault(const std::string & path)
{
  const std::unique_ptr<std::FILE, int (*)(std::FILE *)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (file == nullptr || std::fgetc(file.get()) != 0xff || std::fgetc(file.get()) != 0xd8)
  {
    return {};
  }
  std::rewind(file.get());
  const std::uint64_t        bytes = std::filesystem::file_size(path);
  jpeg_decompress_struct     decoder = {};
  ErrorManager               errors = {};
  std::vector<unsigned char> row;
  decoder.err = jpeg_std_error(&errors.Base);
  errors.Base.error_exit = EndWithError;
  errors.Base.emit_message = HandleMessage;
  if (setjmp(errors.End) == 0)
  {
    jpeg_create_decompress(&decoder);
    Decode(decoder, file.get(), bytes, row); // no temporary, either, which the jump would leave behind
  }
  jpeg_destroy_decompress(&decoder);
  return errors.Text;
}
