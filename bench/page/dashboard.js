// Draws the figures of the dashboard from the data in the page. Library: Chart.js 3.9.1.
(function () {
  'use strict';

  const data = id => JSON.parse(document.getElementById(id).textContent);
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
  const figures = data('figures'), history = data('history');

  // ---- axes ----

  const short = value => Math.abs(value) < 1e-3 ? String(Number(value.toPrecision(4))) :
      value.toLocaleString('en', {maximumSignificantDigits: 4});

  // On a logarithmic axis 1, 2 and 5 of each decade where there is room for them, else its first.
  function logTick(value, index, ticks) {
    const decades = Math.log10(ticks[ticks.length - 1].value / ticks[0].value);
    const share = value / 10 ** Math.floor(Math.log10(value) + 1e-9), digit = Math.round(share);
    if (Math.abs(share - digit) > 1e-6) return '';  // an end of the axis
    return digit === 1 || decades < 2.5 && (digit === 2 || digit === 5) ? short(value) : '';
  }

  // Bars and points at the very edge of a logarithmic axis would not be seen: begin below the least of them.
  function logRange(values) {
    const known = values.filter(v => v > 0);
    return {min: 10 ** Math.floor(Math.log10(Math.min(...known) * 0.7)), max: Math.max(...known) * 1.5};
  }

  function axis(spec, values) {
    const settings = {
      type: spec.log ? 'logarithmic' : 'linear',
      beginAtZero: !spec.log,
      title: {display: true, text: spec.title, color: colour('soft')},
      ticks: {color: colour('soft'), maxRotation: 0, autoSkipPadding: 12, includeBounds: false},
      grid: {color: colour('grid'), borderColor: colour('line')}
    };
    if (spec.log) {
      Object.assign(settings, logRange(values));
      settings.ticks.callback = logTick;
    }
    if (spec.max) settings.max = spec.max;
    if (spec.ticks) {  // the numbers of threads
      putTicks(settings, spec.ticks, short);
      settings.min = 0.9 * Math.min(spec.ticks[0], ...values);
      settings.max = 1.1 * Math.max(spec.ticks[spec.ticks.length - 1], ...values);
    }
    return settings;
  }

  function putTicks(settings, values, words) {
    settings.afterBuildTicks = scale => { scale.ticks = values.map(value => ({value})); };
    settings.ticks.callback = words;
    settings.ticks.autoSkip = false;
  }

  function options(scales, extra) {
    return Object.assign({
      animation: false,
      responsive: true,
      maintainAspectRatio: false,
      scales,
      plugins: {
        legend: {labels: {color: colour('ink'), usePointStyle: true, boxHeight: 6, boxWidth: 14, padding: 10}}
      }
    }, extra);
  }

  // ---- figures of the run ----

  function barChart(figure) {
    const values = figure.series.flatMap(series => series.values).filter(v => v !== null);
    const value = axis(figure.value, values);
    value.stacked = figure.stacked;
    const names = {
      stacked: figure.stacked,
      ticks: {color: colour('ink'), autoSkip: false},
      grid: {display: false, borderColor: colour('line')}
    };
    const nearest = {mode: 'nearest', axis: 'y', intersect: false};
    const chart = options({x: value, y: names}, {indexAxis: 'y', interaction: nearest});
    chart.plugins.legend.display = figure.series.length > 1;
    chart.plugins.tooltip = {callbacks: {label: item => item.dataset.label + ': ' + short(item.parsed.x)}};
    const datasets = figure.series.map(series => ({
      label: series.label,
      data: series.values,
      backgroundColor: colour('s' + series.colour),
      borderColor: colour('s' + series.colour),
      pointStyle: 'rect',
      maxBarThickness: figure.stacked ? 20 : 14,
      barPercentage: 0.95,
      categoryPercentage: 0.8
    }));
    return {type: 'bar', data: {labels: figure.categories, datasets}, options: chart};
  }

  function curve(series) {
    const paint = colour('s' + series.colour);
    return {
      label: series.label,
      data: series.values.map(([x, y]) => ({x, y})),
      borderColor: paint,
      backgroundColor: paint,
      borderWidth: 1.8,
      borderDash: series.dashed ? [6, 4] : [],
      pointRadius: series.dashed ? 0 : 3.5,
      pointHitRadius: 6,
      pointStyle: series.dashed ? 'line' : 'circle',
      showLine: true,
      tension: 0
    };
  }

  function lineChart(figure) {
    const of = k => figure.series.flatMap(series => series.values.map(point => point[k]));
    const nearest = {mode: 'nearest', axis: 'x', intersect: false};
    const chart = options({x: axis(figure.x, of(0)), y: axis(figure.y, of(1))}, {interaction: nearest});
    if (figure.x.log && !figure.x.ticks) {
      chart.scales.x.min = Math.min(...of(0)) / 1.2;
      chart.scales.x.max = Math.max(...of(0)) * 1.2;
    }
    chart.plugins.tooltip = {callbacks: {
      title: items => items.length ? figure.x.title + ': ' + items[0].parsed.x.toLocaleString('en') : '',
      label: item => item.dataset.label + ': ' + short(item.parsed.y)
    }};
    return {type: 'scatter', data: {datasets: figure.series.map(curve)}, options: chart};
  }

  function draw(canvas, chart) {
    const old = Chart.getChart(canvas);
    if (old) old.destroy();
    return new Chart(canvas, chart);
  }

  function drawFigures() {
    document.querySelectorAll('canvas[data-figure]').forEach(canvas => {
      const figure = figures[Number(canvas.dataset.figure)];
      draw(canvas, figure.type === 'bar' ? barChart(figure) : lineChart(figure));
    });
  }

  // ---- history ----

  const units = [['s', 1], ['ms', 1e-3], ['µs', 1e-6], ['ns', 1e-9]];
  const day = ms => new Date(ms).toISOString().slice(0, 10);

  function historyChart(points) {
    const greatest = Math.max(...points.map(point => point[3] ?? point[1]));
    const [unit, size] = units.find(([, seconds]) => greatest >= seconds) || units[3];
    // without a range the band has no width
    const column = k => points.map(point => ({x: point[0], y: (point[k] ?? point[1]) / size}));
    const paint = colour('s0'), few = points.length === 1, bare = few || points.every(point => point[2] === null);
    const band = {
      borderWidth: 0, pointRadius: 0, pointHitRadius: 0, pointStyle: 'rect', showLine: true,
      backgroundColor: paint + '40', borderColor: 'transparent'
    };
    const median = {
      borderWidth: 1.8, pointRadius: 3.5, pointHitRadius: 8, pointStyle: 'circle', showLine: true,
      backgroundColor: paint, borderColor: paint
    };
    const datasets = [
      Object.assign({}, band, {label: '', data: column(2)}),
      Object.assign({}, band, {label: 'fastest to slowest', data: column(3), fill: 0}),
      Object.assign({}, median, {label: 'median', data: column(1)})
    ];
    const x = axis({title: 'commit date'}, []), y = axis({title: 'time of one iteration, ' + unit}, []);
    const first = points[0][0], last = points[points.length - 1][0], margin = few ? 864e5 : 0.03 * (last - first);
    Object.assign(x, {beginAtZero: false, min: first - margin, max: last + margin});
    putTicks(x, few ? [first] : [0, 1, 2, 3].map(k => first + k * (last - first) / 3), value => day(value));
    y.beginAtZero = false;
    y.grace = '15%';
    const chart = options({x, y}, {interaction: {mode: 'nearest', axis: 'x', intersect: false}});
    chart.plugins.legend.labels.filter = item => item.text !== '';
    chart.plugins.tooltip = {filter: item => item.datasetIndex === 2, callbacks: {
      title: items => items.length ? day(points[items[0].dataIndex][0]) + '  ' + points[items[0].dataIndex][5] : '',
      label: item => {
        const [, median, least, most, n] = points[item.dataIndex];
        const range = least === null ? '' : `${short(least / size)} to ${short(most / size)}, `;
        return `${short(median / size)} ${unit}  (${range}n = ${n})`;
      }
    }};
    return {type: 'scatter', data: {datasets: datasets.slice(bare ? 2 : 0)}, options: chart};
  }

  function historyRow(point) {
    const [when, median, least, most, n, commit] = point;
    const [unit, size] = units.find(([, seconds]) => (most ?? median) >= seconds) || units[3];
    const time = value => value === null ? '–' : short(value / size) + ' ' + unit;
    const row = document.createElement('tr');
    [day(when), commit, ...[median, least, most].map(time), n].forEach((text, i) => {
      const cell = row.insertCell();
      cell.textContent = text;
      if (i > 1) cell.className = 'n';
    });
    return row;
  }

  function drawHistory() {
    const chooser = document.getElementById('history-benchmark');
    if (!chooser) return;
    document.querySelectorAll('figure[data-place]').forEach(figure => {
      const points = history[figure.dataset.place][chooser.value] || [];
      const canvas = figure.querySelector('canvas');
      canvas.parentNode.hidden = !points.length;
      figure.querySelector('.gap').hidden = points.length > 0;
      figure.querySelector('tbody').replaceChildren(...points.map(historyRow).reverse());
      if (points.length) draw(canvas, historyChart(points));
    });
  }

  // ---- the page ----

  function drawAll() {
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    drawFigures();
    drawHistory();
  }

  drawAll();
  const chooser = document.getElementById('history-benchmark');
  if (chooser) chooser.addEventListener('change', drawHistory);
  window.matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawAll);
  window.addEventListener('beforeprint', () => Object.values(Chart.instances).forEach(chart => chart.resize()));
})();
