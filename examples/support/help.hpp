/// Help texts that fit a terminal of 80 columns.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace examples {

inline constexpr std::size_t help_columns = 80;

/// The words of a text as lines of at most help_columns bytes from column `indent` on (a longer word has a line of its own). The first line
/// starts at column `column`, where the text is to be appended; if nothing fits there, on a new line. A single line break counts as a space,
/// so that texts may be broken in the source; an empty line stays.
[[nodiscard]] inline std::string wrapped(std::string_view text, std::size_t indent, std::size_t column) {
  std::string lines;
  const auto break_line = [&] {
    lines += '\n' + std::string(indent, ' ');
    column = indent;
  };
  bool at_start = true;  // of a paragraph or a line
  for (std::size_t paragraph = 0; !text.empty(); ++paragraph) {
    const std::size_t end = std::min(text.find("\n\n"), text.size());
    std::string_view unread = text.substr(0, end);
    text.remove_prefix(std::min(end + 2, text.size()));
    if (paragraph > 0) {
      lines += '\n';
      break_line();
      at_start = true;
    }
    while (true) {
      unread.remove_prefix(std::min(unread.find_first_not_of(" \n"), unread.size()));
      if (unread.empty()) break;
      const std::string_view word = unread.substr(0, unread.find_first_of(" \n"));
      unread.remove_prefix(word.size());
      if (column + (at_start ? 0 : 1) + word.size() > help_columns && column > indent) {
        break_line();
        at_start = true;
      }
      if (!at_start) lines += ' ';
      lines += word;
      column += word.size() + (at_start ? 0 : 1);
      at_start = false;
    }
  }
  return lines;
}

/// Lays out what --help prints: options left, what they do right of them, groups apart.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override { return wrapped(app->get_description(), 0, 0) + "\n\n"; }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    return wrapped(CLI::Formatter::make_usage(app, std::move(name)), 7, 0) + "\n\n";
  }

  std::string make_positionals(const CLI::App* app) const override {
    const std::string positionals = CLI::Formatter::make_positionals(app);
    return positionals.empty() ? "" : positionals + '\n';
  }

  std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override {
    std::string text = group + ":\n";
    for (const CLI::Option* option : options) text += make_option(option, is_positional);
    return text;
  }

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    std::string text = "  " + make_option_name(option, is_positional) + make_option_opts(option);
    text = wrapped(text.substr(2), words_column, 2);
    text.insert(0, "  ");
    const std::size_t last_line = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
    std::size_t column = text.size() - last_line;
    if (column + 2 > words_column) {
      text += '\n';
      column = 0;
    }
    text += std::string(words_column - column, ' ');
    return text + wrapped(make_option_desc(option), words_column, words_column) + '\n';
  }

  /// What CLI11 says of a check is left out unless it lists the words that are allowed.
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = CLI::Formatter::make_option_opts(option);
    const std::string type = option->get_type_name();
    const std::size_t colon = type.find(':');
    if (colon == std::string::npos) return text;
    const bool is_list = type.compare(colon + 1, 1, "{") == 0;
    return text.replace(text.find(type), type.size(), is_list ? type.substr(colon + 1) : type.substr(0, colon));
  }

 private:
  static constexpr std::size_t words_column = 26;
};

}  // namespace examples
