// SPDX-License-Identifier: Apache-2.0
// Holds nothing: the header that all tests share is compiled for it (tests/CMakeLists.txt).
