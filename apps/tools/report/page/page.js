// The page of `encode --report` and of bench/joint --figures. `report` is what was measured
// (apps/tools/report/report_page.cpp), d3 is D3 5.
'use strict';

const width = 560, height = 400, margin = {top: 14, right: 18, bottom: 44, left: 62};
const inner = {left: margin.left, right: width - margin.right,
               top: margin.top, bottom: height - margin.bottom};

const bytesText = (bytes) => bytes < 1000 ? `${Math.round(bytes)} B`
    : bytes < 1e6 ? `${d3.format('.3~r')(bytes / 1000)} kB`
    : `${d3.format('.3~r')(bytes / 1e6)} MB`;
const decibels = (psnr) => psnr === null ? 'exact' : `${psnr.toFixed(2)} dB`;

/** Axes of a chart with names, and a grid. Byte axes are logarithmic. */
function frame(id, x, y, names, ticks) {
  const svg = d3.select(`#${id}`).append('svg').attr('viewBox', [0, 0, width, height])
      .attr('role', 'img');
  svg.append('clipPath').attr('id', `${id}-inside`).append('rect')
      .attr('x', inner.left).attr('y', inner.top)
      .attr('width', inner.right - inner.left).attr('height', inner.bottom - inner.top);
  const bottom = (size) => ticks.x(d3.axisBottom(x)).tickSizeInner(size);
  const left = (size) => ticks.y(d3.axisLeft(y)).tickSizeInner(size);
  const place = (g, axis, where) => g.attr('transform', where).call(axis);
  const down = `translate(0,${inner.bottom})`, right = `translate(${inner.left},0)`;
  place(svg.append('g').attr('class', 'grid'),
        bottom(inner.top - inner.bottom).tickFormat(''), down);
  place(svg.append('g').attr('class', 'grid'),
        left(inner.left - inner.right).tickFormat(''), right);
  const plot = svg.append('g').attr('clip-path', `url(#${id}-inside)`);
  place(svg.append('g'), bottom(5), down);
  place(svg.append('g'), left(5), right);
  svg.append('text').attr('class', 'name').attr('text-anchor', 'middle')
      .attr('x', (inner.left + inner.right) / 2).attr('y', height - 6).text(names.x);
  svg.append('text').attr('class', 'name').attr('text-anchor', 'middle')
      .attr('transform', `translate(14,${(inner.top + inner.bottom) / 2}) rotate(-90)`)
      .text(names.y);
  return plot;
}

const logTicks = (scale) => {
  const [low, high] = scale.domain();
  const all = [];
  for (let power = 1; power <= high; power *= 10)
    for (const digit of [1, 2, 5]) all.push(power * digit);
  const shown = all.filter((value) => value >= low && value <= high);
  const values = shown.length <= 7 ? shown : shown.filter((_, i) => i % 2 === shown.length % 2);
  return (axis) => axis.tickValues(values).tickFormat(bytesText);
};

const logScale = (domain, range) => d3.scaleLog().domain(domain).range(range);

/** Shows what `text` says of the mark below the pointer. */
function tips(id, marks, text) {
  const chart = d3.select(`#${id}`);
  const tip = chart.append('div').attr('class', 'tip').style('display', 'none');
  marks.on('mouseenter', (d) => {
    const box = chart.node().getBoundingClientRect();
    tip.style('display', null).text(text(d)).style('left', `${d3.event.clientX - box.left}px`)
        .style('top', `${d3.event.clientY - box.top}px`);
  }).on('mouseleave', () => tip.style('display', 'none'));
}

/** Figure 6.6: every pair, a line a texture rate; the hull; the stream itself. */
function rates(plane) {
  const seen = plane.pairs.filter((pair) => pair.psnr !== null);
  const cuts = report.cuts.filter((cut) => cut.screen !== null);
  const total = (pair) => pair.heights + pair.texture;
  const x = logScale(d3.extent(seen, total), [inner.left, inner.right]);
  const y = d3.scaleLinear().domain(d3.extent([...seen.map((p) => p.psnr),
      ...cuts.map((c) => c.screen)])).nice().range([inner.bottom, inner.top]);
  const plot = frame('rates', x, y, {x: 'bytes of heights and texture', y: 'screen PSNR, dB'},
                     {x: logTicks(x), y: (axis) => axis.ticks(7)});
  const line = d3.line().x((p) => x(total(p))).y((p) => y(p.psnr));
  for (const {values} of d3.nest().key((p) => p.texture).entries(seen))
    plot.append('path').attr('class', 'rate').attr('d', line(values));
  const dots = (name, data, radius, at) => plot.append('g').selectAll('circle').data(data)
      .join('circle').attr('class', name).attr('r', radius)
      .attr('cx', (p) => x(at(p)[0])).attr('cy', (p) => y(at(p)[1]));
  const one = (p) => `${bytesText(p.heights)} of heights\n${bytesText(p.texture)} of texture\n`
      + decibels(p.psnr);
  const at = (p) => [total(p), p.psnr];
  const all = dots('pair', seen, 2.6, at);
  plot.append('path').attr('class', 'best').attr('d',
      line(plane.hull.filter((p) => p.psnr !== null)));
  tips('rates', all, one);
  const whole = (cut) => [cut.geometry + cut.texture, cut.screen];
  plot.append('path').attr('class', 'shipped').attr('d', d3.line().x((c) => x(whole(c)[0]))
      .y((c) => y(whole(c)[1]))(cuts));
  tips('rates', dots('shipped', cuts, 4.5, whole),
       (cut) => `the stream's first ${bytesText(cut.bytes)}\n${decibels(cut.screen)}`);
}

/** Values of the grid, with so many steps of straight lines between two of its nodes. */
function refined(values, columns, rows, steps) {
  const fine = [], n = (columns - 1) * steps + 1, m = (rows - 1) * steps + 1;
  for (let j = 0; j < m; ++j)
    for (let i = 0; i < n; ++i) {
      const c = Math.min(Math.floor(i / steps), Math.max(0, columns - 2));
      const r = Math.min(Math.floor(j / steps), Math.max(0, rows - 2));
      const u = i / steps - c, v = j / steps - r;
      const at = (a, b) =>
        values[Math.min(r + b, rows - 1) * columns + Math.min(c + a, columns - 1)];
      fine.push((1 - u) * (1 - v) * at(0, 0) + u * (1 - v) * at(1, 0)
                + (1 - u) * v * at(0, 1) + u * v * at(1, 1));
    }
  return {fine, n, m};
}

/** Figures 6.7 and 6.8: lines of equal `values` over heights (x) and texture (y), and paths. */
function plane(id, data, values, thresholds, colour, label, marks) {
  const x = logScale([data.heights[0], data.heights[data.heights.length - 1]],
                     [inner.left, inner.right]);
  const y = logScale([data.textures[0], data.textures[data.textures.length - 1]],
                     [inner.bottom, inner.top]);
  const plot = frame(id, x, y, {x: 'bytes of heights', y: 'bytes of texture'},
                     {x: logTicks(x), y: logTicks(y)});
  const {fine, n, m} = refined(values, data.heights.length, data.textures.length, 8);
  // A contour's coordinate c lies on the node c - 1/2, and the nodes are even on logarithmic axes.
  const transform = d3.geoTransform({point(c, r) {
    this.stream.point(inner.left + (c - 0.5) / (n - 1) * (inner.right - inner.left),
                      inner.bottom - (r - 0.5) / (m - 1) * (inner.bottom - inner.top));
  }});
  const path = d3.geoPath(transform);
  const low = Math.min(...fine);
  const levels = d3.contours().size([n, m]).thresholds([low, ...thresholds])(fine);
  plot.append('g').selectAll('path').data(levels).join('path').attr('class', 'iso')
      .attr('d', path).style('fill', (level) => colour(level.value));
  plot.append('g').selectAll('text').data(levels.slice(1)).join('text').attr('class', 'level')
      .each(function(level) {
        // On the diagonal, where lines lie side by side.
        for (let k = 1; k < 200; ++k) {
          const i = Math.round(k / 200 * (n - 1)), j = Math.round(k / 200 * (m - 1));
          const before = fine[Math.round((k - 1) / 200 * (m - 1)) * n
                              + Math.round((k - 1) / 200 * (n - 1))];
          if (before < level.value && fine[j * n + i] >= level.value) {
            d3.select(this).attr('x', inner.left + i / (n - 1) * (inner.right - inner.left))
                .attr('y', inner.bottom - j / (m - 1) * (inner.bottom - inner.top) + 4)
                .text(label(level.value));
            return;
          }
        }
      });
  const line = d3.line().x((p) => x(Math.max(p.heights, x.domain()[0])))
      .y((p) => y(Math.max(p.texture, y.domain()[0])));
  for (const name of ['shipped', 'hull', 'greedy'])
    plot.append('path').attr('class', name === 'hull' ? 'best' : name).attr('d', line(data[name]));
  const dots = plot.append('g').selectAll('circle').data(data.greedy).join('circle')
      .attr('class', 'greedy').attr('r', 2.4).attr('cx', (p) => x(p.heights))
      .attr('cy', (p) => y(p.texture));
  const say = (p) => `${p.name ? `${p.name}: ` : ''}${bytesText(p.heights)} of heights\n`
      + `${bytesText(p.texture)} of texture\n${decibels(p.psnr)}`;
  tips(id, dots, say);
  if (!marks) return;
  const models = plot.append('g').selectAll('g').data(marks).join('g')
      .attr('transform', (p) => `translate(${x(p.heights)},${y(p.texture)})`);
  models.append('circle').attr('class', 'mark').attr('r', 7);
  models.append('text').attr('text-anchor', 'middle').attr('y', 4).text((p) => p.name);
  tips(id, models, say);
}

/** Where the bytes of the stream go, from its first to its last. */
function split(path) {
  const points = path.filter((p) => p.heights + p.texture > 0)
      .map((p) => ({bytes: p.heights + p.texture, part: p.heights / (p.heights + p.texture)}));
  const x = logScale(d3.extent(points, (p) => p.bytes), [inner.left, inner.right]);
  const y = d3.scaleLinear().domain([0, 1]).range([inner.bottom, inner.top]);
  const plot = frame('split', x, y, {x: 'bytes of the stream so far', y: 'shared between'},
                     {x: logTicks(x), y: (axis) => axis.ticks(5, '%')});
  const area = d3.area().x((p) => x(p.bytes)).curve(d3.curveMonotoneX);
  const fill = (name, from, to) => plot.append('path').style('fill', `var(--${name})`)
      .style('fill-opacity', .85).attr('d', area.y0((p) => y(from(p))).y1((p) => y(to(p)))(points));
  fill('heights', () => 0, (p) => p.part);
  fill('texture', (p) => p.part, () => 1);
}

/** Buttons of which one is on. */
function buttons(id, names, chosen) {
  const all = d3.select(`#${id}`).selectAll('button').data(names).join('button')
      .text((name) => name).on('click', (name, i) => choose(i));
  const choose = (i) => {
    all.classed('on', (name, k) => k === i);
    chosen(i);
  };
  return choose;
}

/** The original beside a cut, which a slider uncovers. Pictures are those of the plates below. */
function slider() {
  const cameras = [...document.querySelectorAll('[data-camera]')];
  const shown = {camera: 0, cut: 0};
  const box = document.querySelector('.slider');
  const show = () => {
    const plates = cameras[shown.camera].querySelectorAll('img');
    box.querySelector('.original').src = plates[0].src;
    box.querySelector('.cut').src = plates[1 + shown.cut].src;
    box.querySelector('.right').textContent = plates[1 + shown.cut].alt;
    cameras.forEach((camera, i) => { camera.hidden = i !== shown.camera; });
  };
  box.querySelector('input').addEventListener('input', (event) =>
      box.style.setProperty('--at', `${event.target.value}%`));
  const camera = buttons('cameras', report.cameras, (i) => { shown.camera = i; show(); });
  const cut = buttons('cuts', report.cuts.map((c) => bytesText(c.bytes)),
                      (i) => { shown.cut = i; show(); });
  camera(0);
  cut(Math.min(2, report.cuts.length - 1));
}

/** Figure 6.4: the edges of a mesh from above, and where the viewer stands. */
function meshPlan(id, mesh) {
  const border = 0.06 * Math.max(mesh.width, mesh.height);
  const clamp = (value, high) => Math.max(-border / 2, Math.min(high + border / 2, value));
  const svg = d3.select(`#${id}`).append('svg').attr('viewBox',
      [-border, -border, mesh.width + 2 * border, mesh.height + 2 * border]);
  svg.append('path').style('stroke', '#3b4b5c').style('stroke-width', mesh.width / 900)
      .attr('d', mesh.edges.map(([x, y, u, v]) => `M${x},${y}L${u},${v}`).join(''));
  svg.append('circle').attr('r', border / 3).style('fill', 'var(--greedy)')
      .attr('cx', clamp(mesh.eye[0], mesh.width)).attr('cy', clamp(mesh.eye[1], mesh.height));
}

if (report.cuts.length > 0) slider();
report.meshes.forEach((mesh, i) => meshPlan(`mesh-${i}`, mesh));
if (report.plane) {
  const data = report.plane;
  const finite = data.pairs.map((pair) => pair.psnr).filter((psnr) => psnr !== null);
  const most = Math.max(...finite);
  rates(data);
  // Rows of textures for each of the heights become rows of heights for each texture.
  const turned = (value) => data.textures.flatMap((_, t) =>
      data.heights.map((__, h) => value(data.pairs[h * data.textures.length + t])));
  const psnr = turned((pair) => pair.psnr === null ? most : pair.psnr);
  const steps = d3.ticks(Math.min(...finite), most, 12);
  plane('iso-psnr', data, psnr, steps,
        d3.scaleSequential(d3.interpolateViridis).domain([Math.min(...finite), most]),
        (value) => `${value}`, data.equal_psnr);
  const bytes = turned((pair) => Math.log2(pair.heights + pair.texture));
  const powers = d3.range(Math.ceil(Math.min(...bytes)), Math.max(...bytes));
  plane('iso-bytes', data, bytes, powers,
        d3.scaleSequential(d3.interpolateBlues)
          .domain([Math.min(...bytes) - 4, Math.max(...bytes)]),
        (value) => bytesText(2 ** value), data.equal_bytes);
  split(data.shipped);
}
