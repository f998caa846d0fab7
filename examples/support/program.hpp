/// How an example ends: its exit code and what it says when it fails.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "incognita/io/input_error.hpp"
#include "support/output_folder.hpp"

namespace examples {

/// Calls run(), which parses the command line by `app` and does the work. Returns 0, 2 after one line on
/// stderr for bad arguments, bad files and places that cannot be written, 1 after one for anything else.
template <class Run>
[[nodiscard]] int run_program(const std::string& name, const CLI::App& app, Run&& run) {
  const auto refuse = [&](const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 2;
  };
  try {
    run();
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : refuse(error);
  } catch (const incognita::InputError& error) {
    return refuse(error);
  } catch (const std::invalid_argument& error) {
    return refuse(error);
  } catch (const OutputError& error) {
    return refuse(error);
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 1;
  }
  if (std::fflush(stdout) != 0 || !std::cout.flush()) {
    std::cerr << name << ": cannot write to the standard output\n";
    return 1;
  }
  return 0;
}

}  // namespace examples
