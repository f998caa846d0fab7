// What names in a recording mean.

const stopReasons = {
  complete: ['The floor is explored', 'No frontier is left: nowhere does known free floor border on the unknown.'],
  nothing_informative: ['Nothing more to learn', 'Frontiers are left, but going there would tell nothing new, or was tried and given up. Most often these are slivers behind corners. As good as complete.'],
  nothing_reachable: ['Nothing more to reach', 'Frontiers are left, but the robot’s body cannot get to where any of them is seen, or it stands where it cannot move. When it was asked to return: it found no way back, or not in time.'],
  lost: ['The robot was lost', 'Its pose became more uncertain than the bound that was given, or its scans contradicted the map for too long, so it stopped.'],
  out_of_time: ['The time was up', 'The longest duration that was asked for was over before the exploration was.'],
  stopped: ['Stopped on request', 'Someone told the explorer to stop.'],
  returned: ['Back at the start', 'The exploration was over and the robot has returned to where it started.'],
};

const decisionReasons = {
  no_goal: 'There was no goal: at the start, or after a pause.',
  arrived: 'The robot had arrived at its goal.',
  in_vain: 'It had arrived, but nothing around had changed: that goal is set aside.',
  overdue: 'The way took too long: that goal is set aside.',
  path_closed: 'Something had come in the way.',
  seen_enough: 'What the goal was chosen for had been seen on the way.',
  learned: 'Enough had been learned to compare goals again.',
  way_in_doubt: 'The robot was found elsewhere, the map was drawn again, or a retreat was over.',
  ended: 'Nothing was decided but to stop.',
};

// Of final metrics: what they are, in the order in which they are shown.
const metricWords = {
  stop_reason: 'why the exploration ended',
  duration_s: 'simulated time that the exploration took',
  explored_fraction: 'part of the visible floor that is known in the end',
  explored_area_m2: 'the same as an area',
  time_to_90_percent_s: 'when nine tenths of the floor were known',
  distance_m: 'how far the robot has driven',
  distance_to_90_percent_m: 'how far until nine tenths were known',
  returned: 'whether it came back to the start, if asked to',
  return_distance_m: 'how far the way back was',
  touched_cells: 'how many cells the map has touched',
  collisions: 'how often the robot’s body touched a wall',
  decisions: 'how often a goal was chosen',
  scans: 'how many scans the robot took',
  translation_rmse_m: 'root mean square distance between estimated and true position',
  translation_mae_m: 'mean distance between estimated and true position',
  heading_rmse_rad: 'root mean square error of the heading',
  nees_mean: 'mean of the position’s NEES: 2 when the filter is honest, less when it is cautious',
  map_error: 'part of the known cells that are wrong',
  map_uncertainty_bits_per_step: 'uncertainty removed from the map for each step',
  wall_time_s: 'how long the computer took',
  real_time_factor: 'how many times faster than real time that was',
  threads: 'how many threads evaluated candidates',
};

const units = [[/_m2$/, 'm²'], [/_m_per_s$/, 'm/s'], [/_rad_per_s$/, 'rad/s'], [/_per_m$/, '1/m'], [/_m$/, 'm'], [/_s$/, 's'], [/_rad$/, 'rad'], [/_deg$/, '°'],
  [/_nats_m2$/, 'nats m²'], [/_nats$/, 'nats'], [/_bits_per_step$/, 'bits'], [/_bits$/, 'bits'], [/_percent$/, '%']];

function unitOf(name) {
  return units.find(([pattern]) => pattern.test(name))?.[1] ?? '';
}

// 'map_entropy_bits' as 'map entropy'.
function plainName(name) {
  const unit = units.find(([pattern]) => pattern.test(name));
  return name.replace(unit ? unit[0] : '', '').replaceAll('_', ' ');
}

function number(value, digits) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  return value.toLocaleString('en-GB', { minimumFractionDigits: digits, maximumFractionDigits: digits });
}

// Four digits that count.
function shortNumber(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (Number.isInteger(value)) return String(value);
  return String(Number(value.toPrecision(4)));
}

function shownValue(value) {
  if (typeof value === 'number') return shortNumber(value);
  if (value === null || value === undefined) return '–';
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  return typeof value === 'string' ? value : JSON.stringify(value);
}

function clock(seconds) {
  const whole = Math.floor(seconds + 0.05);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}
