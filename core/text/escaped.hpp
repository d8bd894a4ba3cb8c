#pragma once

#include <string>
#include <string_view>

namespace talus {

/// Text as it stands in XML and HTML, in attributes as well; control characters become question marks.
std::string escaped(std::string_view text);

}  // namespace talus
