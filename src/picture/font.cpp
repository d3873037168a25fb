#include "picture/font.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wcast-align"
#endif
#include <stb/stb_truetype.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

// The bytes of the font file.
__asm__(
    ".pushsection .rodata\n"
    ".balign 16\n"
    ".hidden quasimc_font\n"
    ".global quasimc_font\n"
    "quasimc_font:\n"
    ".incbin \"" QUASIMC_FONT
    "\"\n"
    ".popsection\n");
extern "C" {
extern const unsigned char quasimc_font[];  // NOLINT(modernize-avoid-c-arrays)
}

namespace quasimc {
namespace {

const stbtt_fontinfo& font() {
    static const stbtt_fontinfo info = [] {
        stbtt_fontinfo made;
        const unsigned char* bytes = quasimc_font;
        if (stbtt_InitFont(&made, bytes, stbtt_GetFontOffsetForIndex(bytes, 0)) == 0) {
            throw std::runtime_error("the font is not readable");
        }
        return made;
    }();
    return info;
}

/// The letters of a text; U+FFFD for invalid UTF-8.
std::vector<int> code_points(std::string_view utf8) {
    std::vector<int> points;
    for (std::size_t i = 0; i < utf8.size();) {
        const auto lead = static_cast<unsigned char>(utf8[i++]);
        const int more = lead < 0x80    ? 0
                         : lead >= 0xF0 ? 3
                         : lead >= 0xE0 ? 2
                         : lead >= 0xC0 ? 1
                                        : -1;
        int point = more <= 0 ? lead : lead & (0x3F >> more);
        bool is_whole = more >= 0;
        for (int k = 0; k < more && is_whole; ++k) {
            is_whole = i < utf8.size() && (static_cast<unsigned char>(utf8[i]) & 0xC0U) == 0x80U;
            point =
                is_whole ? (point << 6) | (static_cast<unsigned char>(utf8[i++]) & 0x3F) : point;
        }
        points.push_back(is_whole ? point : 0xFFFD);
    }
    return points;
}

/// A letter, and the position of its left end.
struct Letter {
    int glyph;
    double x;
};

/// A text as letters, and its width.
std::vector<Letter> set_letters(std::string_view utf8, double scale, double& width) {
    std::vector<Letter> letters;
    double x = 1;
    for (const int point : code_points(utf8)) {
        const int glyph = stbtt_FindGlyphIndex(&font(), point);
        if (!letters.empty()) {
            x += scale * stbtt_GetGlyphKernAdvance(&font(), letters.back().glyph, glyph);
        }
        letters.push_back({glyph, x});
        int advance = 0, bearing = 0;
        stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
        x += scale * advance;
    }
    width = x + 1;
    return letters;
}

void add_letter(const Letter& letter, double scale, TextMask& mask) {
    const auto s = static_cast<float>(scale);
    const double whole = std::floor(letter.x);
    const auto shift = static_cast<float>(letter.x - whole);
    int left = 0, top = 0, right = 0, bottom = 0;
    stbtt_GetGlyphBitmapBoxSubpixel(
        &font(), letter.glyph, s, s, shift, 0, &left, &top, &right, &bottom);
    if (right <= left || bottom <= top) {
        return;
    }
    const auto w = static_cast<std::size_t>(right - left),
               h = static_cast<std::size_t>(bottom - top);
    std::vector<std::uint8_t> bitmap(w * h);
    stbtt_MakeGlyphBitmapSubpixel(
        &font(), bitmap.data(), right - left, bottom - top, right - left, s, s, shift, 0,
        letter.glyph);
    const auto x0 = static_cast<std::ptrdiff_t>(whole) + left;
    const auto y0 = static_cast<std::ptrdiff_t>(mask.baseline) + top;
    for (std::size_t j = 0; j < h; ++j) {
        for (std::size_t i = 0; i < w; ++i) {
            const auto x = x0 + static_cast<std::ptrdiff_t>(i),
                       y = y0 + static_cast<std::ptrdiff_t>(j);
            if (x >= 0 && y >= 0 && x < static_cast<std::ptrdiff_t>(mask.width) &&
                y < static_cast<std::ptrdiff_t>(mask.height)) {
                auto& cell =
                    mask.coverage
                        [static_cast<std::size_t>(y) * mask.width + static_cast<std::size_t>(x)];
                cell = std::max(cell, bitmap[j * w + i]);
            }
        }
    }
}

}  // namespace

TextMask draw_text(std::string_view utf8, double size) {
    int ascent = 0, descent = 0, gap = 0;
    stbtt_GetFontVMetrics(&font(), &ascent, &descent, &gap);
    const double scale = double{stbtt_ScaleForPixelHeight(&font(), static_cast<float>(size))};
    double width = 0;
    const std::vector<Letter> letters = set_letters(utf8, scale, width);
    TextMask mask;
    mask.width = static_cast<std::size_t>(std::ceil(width));
    mask.baseline = std::ceil(scale * ascent);
    mask.height = static_cast<std::size_t>(mask.baseline + std::ceil(-scale * descent) + 1);
    mask.coverage.resize(mask.width * mask.height);
    for (const Letter& letter : letters) {
        add_letter(letter, scale, mask);
    }
    return mask;
}

}  // namespace quasimc
