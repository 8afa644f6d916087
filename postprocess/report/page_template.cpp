// SPDX-License-Identifier: GPL-3.0-or-later
// The file becomes part of the program by the assembler's .incbin (GCC and Clang): a byte list in
// C++ would be 3 MB of source. CMake names the file and compiles this again when it changes.
#include "postprocess/report/page_template.hpp"

asm(".section .rodata\n"
    "ice_page_template: .incbin \"" ICE_PAGE_TEMPLATE
    "\"\n"
    "ice_page_template_end:\n"
    ".previous\n");
extern const char first_byte[] asm("ice_page_template");
extern const char end_byte[] asm("ice_page_template_end");

namespace ice::report {

std::string_view page_template() {
    return {first_byte, static_cast<std::size_t>(end_byte - first_byte)};
}

}  // namespace ice::report
