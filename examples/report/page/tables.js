// Tables of the final metrics and of all parameters, a column for each run.

function makeRow(cells, isHead) {
  const row = document.createElement('tr');
  cells.forEach((text, i) => {
    const cell = document.createElement(isHead || i === 0 ? 'th' : 'td');
    cell.scope = isHead ? 'col' : 'row';
    if (!isHead && i > 0) cell.removeAttribute('scope');
    cell.textContent = text;
    row.append(cell);
  });
  return row;
}

function runHeads(runs) {
  return runs.length === 1 ? ['value'] : runs.map((run, i) => `${'AB'[i]}: ${run.name}`);
}

// Metrics in the order of metricWords, then any others. What is also a parameter is left to the other table.
function fillMetrics(table, runs) {
  const parameters = new Set(runs.flatMap((run) => Object.keys(run.parameters).map((name) => name.split('.').at(-1))));
  const all = [...new Set(runs.flatMap((run) => Object.keys(flattened(run.metrics))))];
  const known = Object.keys(metricWords).filter((name) => all.includes(name));
  const names = [...known, ...all.filter((name) => !(name in metricWords) && !parameters.has(name))];
  table.tHead.append(makeRow(['metric', ...runHeads(runs), 'unit', 'what it is'], true));
  const metrics = runs.map((run) => flattened(run.metrics));
  for (const name of names) {
    const values = metrics.map((values) => shownValue(values[name]));
    table.tBodies[0].append(makeRow([plainName(name), ...values, unitOf(name), metricWords[name] ?? ''], false));
  }
  return names.length;
}

function fillParameters(table, runs) {
  const names = [...new Set(runs.flatMap((run) => Object.keys(run.parameters)))];
  const heads = runs.length > 1 ? ['parameter', ...runHeads(runs), 'differs'] : ['parameter', ...runHeads(runs)];
  table.tHead.append(makeRow(heads, true));
  for (const name of names) {
    const values = runs.map((run) => (name in run.parameters ? shownValue(run.parameters[name]) : '–'));
    const differs = new Set(values).size > 1;
    const row = makeRow([name, ...values, ...(runs.length > 1 ? [differs ? '≠' : ''] : [])], false);
    row.classList.toggle('differs', differs);
    table.tBodies[0].append(row);
  }
  return names.length;
}

// What tells two runs apart, for their titles: 'alpha 0.2'.
function distinctions(runs) {
  if (runs.length < 2) return [''];
  const names = Object.keys(runs[0].parameters).filter(
    (name) => name in runs[1].parameters && shownValue(runs[0].parameters[name]) !== shownValue(runs[1].parameters[name]) && !/output|threads|report|record/.test(name));
  return runs.map((run) => names.slice(0, 3).map((name) => `${plainName(name.split('.').at(-1))} ${shownValue(run.parameters[name])} ${unitOf(name)}`.trim()).join(', '));
}
