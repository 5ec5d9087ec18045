# Debian's mingw-w64, with the threads of POSIX that std::thread needs, and Wine to run what it makes.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
# GoogleTest's project names C, too.
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# The compiler's libraries are where Wine does not look.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
# Where Debian has the one of 64 bits; `wine` asks for the other one, too.
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/lib/wine/wine64)
