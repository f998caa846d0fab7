/// sensor/: beams, scans and what one beam says of one cell. A reading of exactly the sensor's maximum range means that
/// nothing was met; every other reading outside of the sensor's range is ignored and counted.
#pragma once

#include "incognita/sensor/dvl.hpp"
#include "incognita/sensor/field_of_view.hpp"
#include "incognita/sensor/line_segments.hpp"
#include "incognita/sensor/measured_point.hpp"
#include "incognita/sensor/obstacle_field.hpp"
#include "incognita/sensor/ray_cast.hpp"
#include "incognita/sensor/reliable_visibility.hpp"
#include "incognita/sensor/scan.hpp"
