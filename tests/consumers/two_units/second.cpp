/// The second unit that includes everything.
#include <incognita/incognita.hpp>
