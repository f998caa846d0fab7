/// The second unit: a function of io that is not inline fails to link.
#include <incognita/io.hpp>
