#include "report/html_page.hpp"

#include "report/assets.hpp"
#include "text/escaped.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace talus {

std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string_view>>& marks) {
  std::string text(page);
  for (const auto& [name, with] : marks) {
    const std::string mark = fmt::format("{{{{{}}}}}", name);
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) throw std::logic_error(fmt::format("the page has no {}", mark));
    text.replace(at, mark.size(), with);
  }
  return text;
}

std::string plain_page(const std::string& title, const std::string& sentence, const std::string& main) {
  const std::string heading = escaped(title);
  return filled(assets::plain_html, {{"title", heading},
                                     {"style", assets::page_css},
                                     {"heading", heading},
                                     {"sentence", escaped(sentence)},
                                     {"main", main}});
}

std::string card(const std::string& heading, const std::string& note, const std::string& content, bool wide) {
  return fmt::format("<section class=\"card{}\">\n<h2>{} <small>{}</small></h2>\n{}</section>\n",
                     wide ? " wide" : "", escaped(heading), escaped(note), content);
}

std::string tile(const std::string& heading, const std::string& figure, const std::string& note) {
  return fmt::format("<div class=\"card tile\">{}<div class=\"numbers\">{}</div><small>{}</small></div>\n",
                     escaped(heading), escaped(figure), escaped(note));
}

std::string drawing(const std::string& svg) {
  return fmt::format("<div class=\"drawing\">{}</div>\n", svg);
}

}  // namespace talus
