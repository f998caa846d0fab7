/// How an example ends: its exit code, what it says when it fails, and how its help is laid out.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "incognita/io/input_error.hpp"
#include "support/help.hpp"
#include "support/output_folder.hpp"

namespace examples {

/// Calls run(), which parses the command line by `app` and does the work. Returns 0, 2 after one line on
/// stderr for bad arguments, bad files and places that cannot be written, 1 after one for anything else.
template <class Run>
[[nodiscard]] int run_program(const std::string& name, CLI::App& app, Run&& run) {
  app.name(name);
  app.formatter(std::make_shared<HelpFormatter>());
  const auto refuse = [&](const std::exception& error) {
    std::cerr << name << ": " << error.what() << '\n';
    return 2;
  };
  try {
    run();
  } catch (const CLI::ConversionError& error) {
    std::cerr << name << ": " << error.what() << ", but must be a number (N: a whole one)\n";
    return 2;
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
