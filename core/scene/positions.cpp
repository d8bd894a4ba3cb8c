#include "scene/positions.hpp"

#include "scene/syntax.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <utility>

namespace talus {
namespace {

/// Counts what the parser has taken, so that every event knows where it stands.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, std::size_t* taken) : at_(at), taken_(taken) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    ++at_;
    ++*taken_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  std::size_t* taken_;
};

/// Follows the parser through the text and knows the JSON pointer of where it is.
class Walk : public nlohmann::json_sax<Json> {
 public:
  explicit Walk(const std::string& text) : text_(text) {}

  bool run() {
    const char* begin = text_.data();
    return Json::sax_parse(CountingIterator(begin, &taken_), CountingIterator(begin + text_.size(), &taken_),
                           static_cast<nlohmann::json_sax<Json>*>(this), nlohmann::json::input_format_t::json,
                           true, true);
  }

  bool null() override { return scalar(nullptr); }
  bool boolean(bool value) override { return scalar(value); }
  bool number_integer(number_integer_t value) override { return number(value); }
  bool number_unsigned(number_unsigned_t value) override { return number(value); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override { return scalar(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return start(false); }
  bool start_array(std::size_t) override { return start(true); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }

  bool key(string_t& name) override {
    levels_.back().key = name;
    levels_.back().has_key = true;
    return on_key(token_start(text_, taken_));
  }

  bool parse_error(std::size_t byte, const std::string&, const Json::exception& problem) override {
    on_error(byte, problem.what());
    return false;
  }

 protected:
  struct Level {
    bool array;
    std::size_t index = 0;
    std::string key = {};
    bool has_key = false;
  };

  std::string pointer() const {
    std::string all;
    for (const Level& level : levels_) {
      if (level.array) {
        all = below(all, level.index);
      } else if (level.has_key) {
        all = below(all, level.key);
      }
    }
    return all;
  }

  virtual bool on_key(std::size_t /*offset*/) { return true; }
  virtual void on_value(std::size_t /*offset*/, Json&& /*value*/) {}
  virtual void on_end() {}
  virtual bool on_start() { return true; }
  virtual void on_error(std::size_t /*byte*/, const std::string& /*words*/) {}

  const std::string& text_;
  std::vector<Level> levels_;

 private:
  bool scalar(Json&& value) { return finished(token_start(text_, taken_), std::move(value)); }
  bool number(Json&& value) { return finished(number_start(text_, taken_), std::move(value)); }
  bool finished(std::size_t offset, Json&& value) {
    on_value(offset, std::move(value));
    next();
    return true;
  }
  bool start(bool array) {
    on_value(token_start(text_, taken_), array ? Json::array() : Json::object());
    if (!on_start()) return false;
    levels_.push_back({array});
    return true;
  }
  bool end() {
    levels_.pop_back();
    on_end();
    next();
    return true;
  }
  void next() {
    if (levels_.empty()) return;
    levels_.back().has_key = false;
    ++levels_.back().index;
  }

  std::size_t taken_ = 0;
};

class Builder : public Walk {
 public:
  Builder(const std::string& text, const std::string& file) : Walk(text), file_(file), places_(text) {}

  ParsedText build() {
    result_.complete = run();
    return std::move(result_);
  }

 protected:
  bool on_key(std::size_t offset) override {
    const std::string& name = levels_.back().key;
    duplicate_ = open_.back()->contains(name);
    if (!duplicate_) return true;
    mistake(offset, fmt::format("key \"{}\" stands twice in the same object", clipped(name)));
    if (++duplicates_ < most_duplicates) return true;
    mistake(offset, fmt::format("this is key number {} that does: the rest is not read", duplicates_));
    return false;
  }

  void on_value(std::size_t offset, Json&& value) override {
    offset_ = offset;
    if (levels_.empty()) {
      latest_ = &result_.value;
    } else if (levels_.back().array) {
      open_.back()->push_back(nullptr);
      latest_ = &open_.back()->back();
    } else if (duplicate_) {
      discarded_.push_back(std::make_unique<Json>());
      latest_ = discarded_.back().get();
    } else {
      latest_ = &(*open_.back())[levels_.back().key];
    }
    duplicate_ = false;
    *latest_ = std::move(value);
  }

  bool on_start() override {
    if (open_.size() == deepest_nesting) {
      mistake(offset_, fmt::format("nested too deep: a scene needs no more than {} levels", deepest_nesting));
      return false;
    }
    open_.push_back(latest_);
    return true;
  }

  void on_end() override { open_.pop_back(); }

  void on_error(std::size_t byte, const std::string& words) override {
    const SyntaxError error = explain_syntax_error(text_, byte, words);
    mistake(error.offset, error.message);
  }

 private:
  void mistake(std::size_t offset, std::string message) {
    const Place place = places_.at(offset);
    result_.mistakes.push_back(
        {file_, place.line, place.column, clipped(pointer(), longest_pointer), std::move(message)});
  }

  const std::string& file_;
  PlaceCounter places_;
  ParsedText result_;
  std::vector<Json*> open_;
  Json* latest_ = nullptr;
  static constexpr std::size_t most_duplicates = 1000;
  bool duplicate_ = false;
  std::size_t duplicates_ = 0;
  std::size_t offset_ = 0;
  std::vector<std::unique_ptr<Json>> discarded_;
};

class Finder : public Walk {
 public:
  Finder(const std::string& text, const std::set<std::string>& wanted)
      : Walk(text), wanted_(wanted), places_(text) {}

  std::map<std::string, Places> find() {
    run();
    return std::move(found_);
  }

 protected:
  bool on_key(std::size_t offset) override {
    key_offset_ = offset;
    return true;
  }

  void on_value(std::size_t offset, Json&&) override {
    std::string here = pointer();
    if (!wanted_.contains(here) || found_.contains(here)) return;
    const bool keyed = !levels_.empty() && !levels_.back().array;
    const Place key = places_.at(keyed ? key_offset_ : offset);
    found_[std::move(here)] = {places_.at(offset), key};
  }

 private:
  const std::set<std::string>& wanted_;
  PlaceCounter places_;
  std::map<std::string, Places> found_;
  std::size_t key_offset_ = 0;
};

}  // namespace

ParsedText parse_json(const std::string& text, const std::string& file) {
  // The parser takes it for the end of the text.
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
    const Place place = place_of(text, zero);
    ParsedText refused;
    refused.mistakes.push_back({file, place.line, place.column, "",
                                "a byte of 0 stands here: a scene is text in UTF-8; is this UTF-16?"});
    return refused;
  }
  return Builder(text, file).build();
}

std::map<std::string, Places> find_places(const std::string& text, const std::set<std::string>& pointers) {
  return Finder(text, pointers).find();
}

std::string below(const std::string& pointer, const std::string& key) {
  std::string all = pointer + '/';
  for (const char c : key) {
    if (c == '~') {
      all += "~0";
    } else if (c == '/') {
      all += "~1";
    } else {
      all += c;
    }
  }
  return all;
}

std::string below(const std::string& pointer, std::size_t index) {
  return pointer + '/' + std::to_string(index);
}

bool is_within(const std::string& pointer, const std::string& ancestor) {
  return pointer.starts_with(ancestor) &&
         (pointer.size() == ancestor.size() || pointer[ancestor.size()] == '/');
}

}  // namespace talus
