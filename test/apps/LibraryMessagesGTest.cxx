// SPDX-License-Identifier: Apache-2.0
#include "system/files/RegularInput.h"
#include "system/process/LibraryMessages.h"
#include "text/LibraryWarnings.h"

#include "gtest/gtest.h"

#include <cstdio>
#include <iostream>
#include <stdexcept>

#include <sys/stat.h>
#include <unistd.h>

TEST(LibraryMessages, KeepsWhatIsPrintedWhileItExists)
{
  const LibraryMessages outer;
  std::cerr << "one\n";
  {
    const LibraryMessages inner;
    std::cout << "two" << std::endl;
    std::fputs("three\n", stderr);
    EXPECT_EQ(inner.GetText(), "two\nthree\n");
  }
  std::cerr << "four\n";
  EXPECT_EQ(outer.GetText(), "one\ntwo\nthree\nfour\n");
}

TEST(LibraryMessages, WarningsAreFoundOnceInOneLineEach)
{
  const std::string text = "WARNING: In /build/Modules/IO/itkNiftiImageIO.cxx, line 123\n"
                           "NiftiImageIO (0x55d0c0ffee00): a.nii has an odd\n unit\n\n"
                           "Warning: In ./Source/gdcmFragment.h, line 102, function void gdcm::Read()\n"
                           "Fragment could not be read\n\n\n"
                           "TIFFReadDirectory: Warning, Unknown field with tag 700.\n"
                           "TIFFReadDirectory: Warning, Unknown field with tag 700.\n"
                           "TIFFReadDirectory: Warning, Unknown field with tag 701.\n"
                           "Error: it failed\n\n"
                           "libpng warning: iCCP: profile\n";
  EXPECT_EQ(FindLibraryWarnings(text),
            (std::vector<std::string>{ "a.nii has an odd unit",
                                       "Fragment could not be read",
                                       "TIFFReadDirectory: Warning, Unknown field with tag 700.",
                                       "TIFFReadDirectory: Warning, Unknown field with tag 701. Error: it failed",
                                       "libpng warning: iCCP: profile" }));
  EXPECT_TRUE(FindLibraryWarnings("an error\n\nforewarnings\n").empty());
}

TEST(LibraryMessages, LinesOfSourceCodeAreLeftOut)
{
  EXPECT_EQ(RemoveSourceLines("Error: In ./Source/gdcmReader.cxx, line 382, function bool gdcm::Read()\n"
                              "Attempt to read file with VR16bits\n"
                              "Program: ./Source/gdcmElement.txx:46: void Read(): Assertion `0 && \"no\"' failed.\n"
                              "a.h is no image: 3\n"),
            "Attempt to read file with VR16bits\na.h is no image: 3\n");
}

TEST(RegularInput, PipesSocketsAndDevicesAreRefused)
{
  const auto getRefusal = [](const std::string & path) -> std::string {
    try
    {
      CheckIsRegularInput(path);
    }
    catch (const std::runtime_error & error)
    {
      return error.what();
    }
    return "";
  };
  const std::string pipe = testing::TempDir() + "pipe" + std::to_string(getpid());
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(getRefusal(pipe).find(pipe + ": it is a named pipe"), std::string::npos);
  unlink(pipe.c_str());
  EXPECT_NE(getRefusal(pipe).find("No such file"), std::string::npos);
  EXPECT_NE(getRefusal("/dev/zero").find("a device"), std::string::npos);
  EXPECT_EQ(getRefusal("/proc/self/exe"), "");
  EXPECT_EQ(getRefusal("/tmp"), "");
}
