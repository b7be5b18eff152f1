// Draws the plots and the turnable net from the data in the page. Libraries: Chart.js 3.9.1, three.js r111.
(function () {
  'use strict';

  const data = id => {
    const element = document.getElementById(id);
    return element ? JSON.parse(element.textContent) : null;
  };
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();

  // ---- plots ----

  const marks = {  // vertical lines with a word each
    id: 'marks',
    afterDatasetsDraw(chart, args, options) {
      const {ctx, chartArea: area, scales} = chart;
      ctx.save();
      ctx.font = '11px ' + Chart.defaults.font.family;
      ctx.strokeStyle = ctx.fillStyle = colour('soft');
      ctx.setLineDash([3, 3]);
      (options.list || []).forEach((mark, i) => {
        const x = scales.x.getPixelForValue(mark.at);
        if (x < area.left || x > area.right) return;
        ctx.beginPath();
        ctx.moveTo(x, area.top);
        ctx.lineTo(x, area.bottom);
        ctx.stroke();
        const wide = ctx.measureText(mark.label).width + 5;
        ctx.textAlign = x + wide > area.right ? 'right' : 'left';
        ctx.fillText(mark.label, x + (ctx.textAlign === 'right' ? -4 : 4), area.top + 10 + 13 * (i % 3));
      });
      ctx.restore();
    }
  };

  function dataset(curve) {
    const paint = colour('s' + curve.colour % 8);
    const points = curve.style === 'points' || curve.style === 'reference';
    const few = curve.x.length < 12;
    return {
      label: curve.label,
      data: curve.x.map((x, i) => ({x, y: curve.y[i]})),
      showLine: !points,
      borderColor: paint,
      backgroundColor: curve.style === 'reference' ? 'transparent' : paint,
      borderWidth: points ? 2 : 1.6,
      borderDash: curve.style === 'dash' ? [6, 4] : [],
      pointRadius: points ? 5 : few && curve.style === 'line' ? 3.5 : 0,
      pointHitRadius: 6,
      pointStyle: curve.style === 'reference' ? 'rectRot' : points || few ? 'circle' : 'line',
      tension: 0
    };
  }

  function range(plot, axis) {
    let low = Infinity, high = -Infinity;
    plot.curves.forEach(curve => curve[axis].forEach(v => {
      if (v === null) return;
      low = Math.min(low, v);
      high = Math.max(high, v);
    }));
    return [low, high];
  }

  // The same scale along both axes: widen the shorter one.
  function equalScales(plot, canvas) {
    const [xl, xh] = range(plot, 'x'), [yl, yh] = range(plot, 'y');
    const aspect = (canvas.parentNode.clientWidth - 60) / (canvas.parentNode.clientHeight - 80);
    const high = 1.08 * Math.max(yh - yl, (xh - xl) / aspect), wide = high * aspect;
    const round = v => Number(v.toPrecision(3));
    return {
      x: {min: round((xl + xh - wide) / 2), max: round((xl + xh + wide) / 2)},
      y: {min: round((yl + yh - high) / 2), max: round((yl + yh + high) / 2)}
    };
  }

  function axis(title, extra) {
    return Object.assign({
      type: 'linear',
      title: {display: true, text: title, color: colour('soft')},
      ticks: {color: colour('soft'), maxTicksLimit: 8, includeBounds: false},
      grid: {color: colour('grid'), borderColor: colour('line')}
    }, extra);
  }

  function options(plot, canvas) {
    const limits = plot.equal ? equalScales(plot, canvas) : {x: {}, y: {}};
    if (!plot.equal) {
      const [low, high] = range(plot, 'x');
      if (high > low && !plot.curves.some(c => c.style === 'reference')) limits.x = {min: low, max: high};
    }
    if (plot.zero) limits.y.beginAtZero = true;
    return {
      animation: false,
      responsive: true,
      maintainAspectRatio: false,
      normalized: !plot.equal,
      parsing: false,
      interaction: {mode: 'nearest', axis: plot.equal ? 'xy' : 'x', intersect: false},
      scales: {x: axis(plot.x, limits.x), y: axis(plot.y, limits.y)},
      plugins: {
        marks: {list: plot.marks},
        legend: {
          display: plot.curves.length > 1,
          labels: {color: colour('ink'), usePointStyle: true, boxHeight: 6, boxWidth: 18, padding: 10}
        },
        tooltip: {callbacks: {title: items => items.length ? plot.x.split(',')[0] + ' = ' + items[0].parsed.x : ''}}
      }
    };
  }

  function drawPlots() {
    const plots = data('plots');
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    document.querySelectorAll('canvas[data-plot]').forEach(canvas => {
      const plot = plots[Number(canvas.dataset.plot)];
      const old = Chart.getChart(canvas);
      if (old) old.destroy();
      new Chart(canvas, {type: 'scatter', data: {datasets: plot.curves.map(dataset)}, options: options(plot, canvas), plugins: [marks]});
    });
  }

  // ---- turnable net ----

  function bytes(text) {
    const raw = atob(text), out = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i++) out[i] = raw.charCodeAt(i);
    return out;
  }

  // The net of one report: geometry of all frames, and the objects that show one of them.
  function netModel(view, scene) {
    const positions = new Uint16Array(bytes(view.positions).buffer);
    const segments = new Uint16Array(bytes(view.segments).buffer);
    const families = bytes(view.families), levels = bytes(view.levels);
    const rings = new Uint16Array(bytes(view.rings).buffer);
    const waypoints = new Uint16Array(bytes(view.waypoints).buffer);
    const unit = view.size / view.steps, count = families.length;
    const joints = waypoints.length / 4 / view.times.length;  // in each frame
    const line = new THREE.BufferGeometry();
    line.setAttribute('position', new THREE.BufferAttribute(new Float32Array((count + joints) * 6), 3));
    line.setAttribute('color', new THREE.BufferAttribute(new Float32Array((count + joints) * 6), 3));
    const lines = new THREE.LineSegments(line, new THREE.LineBasicMaterial({vertexColors: THREE.VertexColors}));
    lines.frustumCulled = false;
    scene.add(lines);

    const paint = name => new THREE.Color(colour(name));
    const palette = ['net', 'thread', 'tow'].map(family => [0, 1, 2, 3].map(level => paint(family + level)));
    const at = (array, k, into) => into.set(
        view.low[0] + array[k] * unit, view.low[1] + array[k + 1] * unit, view.low[2] + array[k + 2] * unit);
    const place = new THREE.Vector3(), normal = new THREE.Vector3();
    const dot = view.size * 0.011;
    const bodies = (list, make) => list.map(item => {
      const body = make(item);
      scene.add(body);
      return body;
    });
    const ringBodies = bodies(view.ringSizes, ([radius, wire]) => {
      const large = Math.max(radius, view.ringSizes.length > 100 ? 0 : 0.6 * dot);  // a few small rings are drawn larger
      return new THREE.Mesh(new THREE.TorusGeometry(large, Math.max(wire, large / 5), 8, 24),
          new THREE.MeshPhongMaterial({color: paint('ring')}));
    });
    const massBodies = bodies(view.masses, mass => new THREE.Mesh(new THREE.SphereGeometry(dot, 16, 12),
        new THREE.MeshPhongMaterial({color: paint({launcher: 'launcher', split: 'split'}[mass.kind] || 'mass')})));
    bodies(view.balls, ball => {
      const body = new THREE.Mesh(new THREE.SphereGeometry(ball.radius, 48, 32),
          new THREE.MeshPhongMaterial({color: paint('ball2'), shininess: 8}));
      body.position.fromArray(ball.center);
      return body;
    });

    // Where each element's thread goes through rings, in order from the element's first end.
    function bendsOf(frame) {
      const bends = new Map();
      for (let j = frame * joints; j < (frame + 1) * joints; j++) {
        const e = waypoints[4 * j];
        bends.set(e, (bends.get(e) || []).concat(4 * j + 1));
      }
      return bends;
    }

    return function show(frame) {
      const base = frame * view.nodes * 3, xyz = line.attributes.position, rgb = line.attributes.color;
      const bends = bendsOf(frame);
      let used = 0;
      for (let e = 0; e < count; e++) {
        const level = levels[frame * count + e];
        if (level === 0) continue;  // not there yet
        const tint = palette[families[e]][level - 1];
        const point = (array, k) => {
          at(array, k, place);
          xyz.setXYZ(used, place.x, place.y, place.z);
          rgb.setXYZ(used++, tint.r, tint.g, tint.b);
        };
        point(positions, base + 3 * segments[2 * e]);
        for (const k of bends.get(e) || []) {
          point(waypoints, k);  // one piece ends, the next begins
          point(waypoints, k);
        }
        point(positions, base + 3 * segments[2 * e + 1]);
      }
      line.setDrawRange(0, used);
      xyz.needsUpdate = rgb.needsUpdate = true;
      view.masses.forEach((mass, i) => {
        massBodies[i].visible = view.times[frame] > mass.from - 1e-9;
        at(positions, base + 3 * mass.node, massBodies[i].position);
      });
      ringBodies.forEach((ring, i) => {
        const k = (frame * ringBodies.length + i) * 6;
        at(rings, k, ring.position);
        normal.set(rings[k + 3], rings[k + 4], rings[k + 5]).multiplyScalar(2 / view.steps).subScalar(1).normalize();
        ring.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
      });
    };
  }

  // Turns the camera about a point: drag, wheel, pinch, arrow keys.
  function orbit(canvas, camera, view, redraw) {
    const up = new THREE.Vector3().fromArray(view.up), eye = new THREE.Vector3(), target = new THREE.Vector3();
    let distance = 0;
    const fingers = new Map();
    const apply = () => {
      camera.position.copy(target).addScaledVector(eye, distance);
      camera.up.copy(up);
      camera.lookAt(target);
      redraw();
    };
    // Far enough away for the box of all frames to fit.
    const fit = () => {
      const low = new THREE.Vector3().fromArray(view.low), high = new THREE.Vector3().fromArray(view.high);
      view.balls.forEach(ball => {
        const center = new THREE.Vector3().fromArray(ball.center);
        low.min(center.clone().subScalar(ball.radius));
        high.max(center.clone().addScalar(ball.radius));
      });
      target.addVectors(low, high).multiplyScalar(0.5);
      const side = new THREE.Vector3().crossVectors(up, eye).normalize(), above = new THREE.Vector3().crossVectors(eye, side);
      const slope = Math.tan(camera.fov * Math.PI / 360), aspect = canvas.clientWidth / canvas.clientHeight;
      let far = 0;
      for (let corner = 0; corner < 8; corner++) {
        const p = new THREE.Vector3(corner & 1 ? low.x : high.x, corner & 2 ? low.y : high.y, corner & 4 ? low.z : high.z).sub(target);
        far = Math.max(far, p.dot(eye) + 1.06 * Math.max(Math.abs(p.dot(above)) / slope, Math.abs(p.dot(side)) / (slope * aspect)));
      }
      return far;
    };
    const reset = () => {
      eye.fromArray(view.toward).normalize();
      distance = fit();
      apply();
    };
    const turn = (dx, dy) => {
      const side = new THREE.Vector3().crossVectors(up, eye).normalize();
      eye.applyAxisAngle(up, -dx * 0.008);
      const tilted = eye.clone().applyAxisAngle(side.applyAxisAngle(up, -dx * 0.008), -dy * 0.008);
      if (Math.abs(tilted.dot(up)) < 0.995) eye.copy(tilted);
    };
    const shift = (dx, dy) => {
      const scale = distance * Math.tan(camera.fov * Math.PI / 360) * 2 / canvas.clientHeight;
      const side = new THREE.Vector3().crossVectors(up, eye).normalize();
      target.addScaledVector(side, -dx * scale).addScaledVector(new THREE.Vector3().crossVectors(eye, side), dy * scale);
    };
    const zoom = factor => { distance = Math.min(Math.max(distance * factor, 0.05 * view.size), 20 * view.size); };
    const spread = () => {
      const [a, b] = [...fingers.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    };
    canvas.addEventListener('pointerdown', event => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    });
    canvas.addEventListener('pointermove', event => {
      const last = fingers.get(event.pointerId);
      if (!last) return;
      const dx = event.clientX - last.x, dy = event.clientY - last.y;
      const before = fingers.size === 2 ? spread() : 0;
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
      if (fingers.size === 2) {
        zoom(before / spread());
        shift(dx / 2, dy / 2);
      } else if (event.buttons & 2 || event.shiftKey) {
        shift(dx, dy);
      } else {
        turn(dx, dy);
      }
      apply();
    });
    ['pointerup', 'pointercancel'].forEach(name => canvas.addEventListener(name, event => fingers.delete(event.pointerId)));
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.003));
      apply();
    }, {passive: false});
    canvas.addEventListener('dblclick', reset);
    canvas.addEventListener('keydown', event => {
      const move = {ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20]}[event.key];
      if (!move) return;
      event.preventDefault();
      turn(move[0], move[1]);
      apply();
    });
    reset();
  }

  function player(view, show) {
    const slider = document.getElementById('view-time'), label = document.getElementById('view-label');
    const button = document.getElementById('view-play');
    let timer = 0;
    const go = frame => {
      slider.value = frame;
      label.textContent = 't = ' + view.times[frame].toFixed(3) + ' s';
      show(frame);
    };
    const stop = () => {
      clearInterval(timer);
      timer = 0;
      button.textContent = 'Play';
    };
    slider.max = view.times.length - 1;
    slider.addEventListener('input', () => {
      stop();
      go(Number(slider.value));
    });
    button.addEventListener('click', () => {
      if (timer) return stop();
      button.textContent = 'Pause';
      timer = setInterval(() => go((Number(slider.value) + 1) % view.times.length), 100);
    });
    go(view.times.length - 1);
    return () => go(Number(slider.value));
  }

  function netView() {
    const view = data('net-view'), canvas = document.querySelector('#view canvas');
    if (!view || !canvas) return () => {};
    let renderer;
    try {
      renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true});
    } catch (error) {
      const note = document.querySelector('#view .gap');
      note.hidden = false;
      note.textContent = 'This browser shows no WebGL: the turnable view is not available here.';
      return () => {};
    }
    const camera = new THREE.PerspectiveCamera(34, 1, view.size * 0.01, view.size * 60);
    let scene, show, waiting = false;
    const draw = () => {
      waiting = false;
      const wide = canvas.clientWidth, high = canvas.clientHeight;
      if (!wide || !high || !scene) return;
      renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
      renderer.setSize(wide, high, false);
      camera.aspect = wide / high;
      camera.fov = wide < high ? 46 : 34;
      camera.updateProjectionMatrix();
      renderer.render(scene, camera);
    };
    const redraw = () => {
      if (!waiting) waiting = true, requestAnimationFrame(draw);
    };
    const build = () => {
      scene = new THREE.Scene();
      const lamp = new THREE.DirectionalLight(0xffffff, 0.7);
      lamp.position.copy(new THREE.Vector3().fromArray(view.toward)).add(new THREE.Vector3().fromArray(view.up));
      scene.add(new THREE.AmbientLight(0xffffff, 0.55), lamp, new THREE.AxesHelper(0.12 * view.size));
      show = netModel(view, scene);
    };
    build();
    const refresh = player(view, frame => {
      show(frame);
      redraw();
    });
    orbit(canvas, camera, view, redraw);
    window.addEventListener('resize', redraw);
    return () => {
      build();
      refresh();
    };
  }

  drawPlots();
  const repaintNet = netView();
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  dark.addEventListener('change', () => {
    drawPlots();
    repaintNet();
  });
  window.addEventListener('beforeprint', () => document.querySelectorAll('canvas[data-plot]').forEach(canvas => {
    const chart = Chart.getChart(canvas);
    if (chart) chart.resize();
  }));
})();
