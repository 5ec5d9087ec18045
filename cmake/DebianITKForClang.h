// SPDX-License-Identifier: Apache-2.0
#ifndef DebianITKForClang_h
#define DebianITKForClang_h

// What ITK 5.2's headers know of a compiler is written when ITK is built, by CMake, for that kind of compiler alone:
// Debian's refuse any other than g++. The preset clang includes this before all else, in place of their
// itk_compiler_detection.h; it says that the compiler knows C++17.
#ifdef __cplusplus
#  define ITK_COMPILER_DETECTION_H
#  define ITK_COMPILER_IS_Clang 1
#  define ITK_COMPILER_CXX_STATIC_ASSERT 1
#  define ITK_ALIGNAS(X) alignas(X)
#  define ITK_ALIGNOF(X) alignof(X)
#  define ITK_CONSTEXPR constexpr
#  define ITK_DELETED_FUNCTION = delete
#  define ITK_DEPRECATED [[deprecated]]
#  define ITK_DEPRECATED_MSG(MSG) [[deprecated(MSG)]]
#  define ITK_EXTERN_TEMPLATE extern
#  define ITK_FINAL final
#  define ITK_NOEXCEPT noexcept
#  define ITK_NOEXCEPT_EXPR(X) noexcept(X)
#  define ITK_NULLPTR nullptr
#  define ITK_OVERRIDE override
#  define ITK_STATIC_ASSERT(X) static_assert(X, #X)
#  define ITK_STATIC_ASSERT_MSG(X, MSG) static_assert(X, MSG)
#  define ITK_THREAD_LOCAL thread_local
#endif

#endif
