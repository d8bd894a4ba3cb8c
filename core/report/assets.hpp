#pragma once

#include <string_view>

/// The files of core/report/page and the library that draws the charts, built into the program.
namespace talus::assets {

extern const std::string_view page_html, plain_html, page_css, words_js, charts_js, film_js, stage_js,
    motion_js, tables_js, start_js, dygraph_css, dygraph_js;

}  // namespace talus::assets
