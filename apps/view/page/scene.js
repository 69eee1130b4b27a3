"use strict";

// The 3D scene: the tracker's world, metres, y up, the camera at the origin looking along -z.
const FOLLOW_S = 0.4;    // the view lags so long behind who is followed
const JUMP_M = 1.0;      // farther than this the view jumps: another frame was chosen
const TURN = Math.PI / 24;  // of a key
const NEARER = 0.9;      // of a key

// Whether pictures are drawn without a graphics card, where smooth edges cost more than all else.
function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl && gl.getExtension("WEBGL_debug_renderer_info");
  return Boolean(info) && /swiftshader|llvmpipe|software/i.test(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
}

// The people of a frame who are there, or the one that the fields of the frame itself say.
function peopleOf(frame) {
  return frame.people || [frame];
}

class Scene {
  constructor(parent) {
    this.parent = parent;
    this.shown = { skeleton: true, markers: true, surface: false, cloud: true };
    this.figures = new Map();  // by person
    this.follow = true;
    this.changed = true;       // since it was last drawn
    this.renderer = new THREE.WebGLRenderer({ antialias: !drawsInSoftware() });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    parent.prepend(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0x14171c);
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.05, 50);
    this.orbit = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.orbit.enableKeys = false;            // keys.js
    this.renderer.domElement.tabIndex = -1;  // the section that holds it has the focus
    this.orbit.addEventListener("change", () => { this.changed = true; });
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x39404d, 0.85));
    const sun = new THREE.DirectionalLight(0xffffff, 0.55);
    sun.position.set(1, 3, 2);
    this.scene.add(sun);
    this.grid = new THREE.GridHelper(10, 20, 0x4a5362, 0x2e343e);
    this.grid.position.set(0, -1, -2.5);
    this.scene.add(this.grid);
    this.cloud = null;
    this.placed = false;
    new ResizeObserver(() => this.resize()).observe(parent);
    this.resize();
    this.home();
  }

  // Another source: its people and colours.
  begin(hello) {
    for (const figure of this.figures.values()) figure.remove();
    this.figures.clear();
    if (this.cloud) this.cloud.geometry.setDrawRange(0, 0);
    this.hello = hello;
    this.pointColors = labelColors(hello);
    this.placed = false;
    this.target = null;
    this.changed = true;
  }

  home() {
    const target = this.target || new THREE.Vector3(0, 0, -2.5);
    // The whole body is seen in pictures that are higher than wide, too.
    const back = this.camera.aspect < 0.8 ? 3.6 : 2.9;
    this.orbit.target.copy(target);
    this.camera.position.set(target.x + 0.5, target.y + 0.45, target.z + back);
    this.orbit.update();
  }

  // By keys: radians about the person, and a factor of the distance.
  move(turn, tilt, factor) {
    const offset = this.camera.position.clone().sub(this.orbit.target);
    const place = new THREE.Spherical().setFromVector3(offset);
    place.theta += turn;
    place.phi = Math.min(Math.PI - 0.05, Math.max(0.05, place.phi + tilt));
    place.radius = Math.min(20, Math.max(0.3, place.radius * factor));
    this.camera.position.setFromSpherical(place).add(this.orbit.target);
    this.orbit.update();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.parent;
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    this.renderer.setSize(width, height);
    this.changed = true;
  }

  // Pixels with a measurement as points; people's in the colours of their labels.
  showCloud(image, depth, labels) {
    const count = image.width * image.height;
    if (!this.cloud || this.cloud.count !== count) this.makeCloud(count);
    const { positions, colors, geometry } = this.cloud;
    let n = 0;
    for (let y = 0, i = 0; y < image.height; ++y) {
      const fy = (image.cy - y * image.step) / image.fy;
      for (let x = 0; x < image.width; ++x, ++i) {
        if (depth[i] === 0) continue;
        const z = depth[i] * 0.001;
        positions[3 * n] = (x * image.step - image.cx) / image.fx * z;
        positions[3 * n + 1] = fy * z;
        positions[3 * n + 2] = -z;
        const label = labels[i];
        if (label > 0 && label < this.pointColors.length) {
          colors.set(this.pointColors[label], 4 * n);
        } else {
          colors.fill(255 * Math.max(0.12, 0.42 - 0.05 * z), 4 * n, 4 * n + 3);
        }
        ++n;
      }
    }
    this.cloud.points.quaternion.fromArray(image.turn);
    geometry.setDrawRange(0, n);
    for (const attribute of [geometry.attributes.position, geometry.attributes.color]) {
      attribute.updateRange.count = n * attribute.itemSize;
      attribute.needsUpdate = true;
    }
  }

  makeCloud(count) {
    if (this.cloud) this.scene.remove(this.cloud.points);
    const positions = new Float32Array(3 * count);
    const colors = new Uint8Array(4 * count);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3).setUsage(THREE.DynamicDrawUsage));
    geometry.setAttribute("color", new THREE.BufferAttribute(colors, 4, true).setUsage(THREE.DynamicDrawUsage));
    const material = new THREE.PointsMaterial({ size: 0.011, vertexColors: THREE.VertexColors });
    const points = new THREE.Points(geometry, material);
    points.frustumCulled = false;
    points.visible = this.shown.cloud;
    this.scene.add(points);
    this.cloud = { count, positions, colors, geometry, points };
  }

  // `chosen`: number of the person whom the view follows.
  showFrame(frame, chosen) {
    if (this.shown.cloud) this.showCloud(frame.image, frame.depth, frame.labels);
    this.grid.position.y = frame.floor_y;
    const people = peopleOf(frame);
    const present = new Set();
    for (const person of people) {
      const number = person.person || 1;
      present.add(number);
      this.figureOf(number).show(person, this.shown);
    }
    for (const [number, figure] of this.figures) if (!present.has(number)) figure.hide();
    const there = people.filter((person) => person.joints);
    const followed = there.find((person) => (person.person || 1) === chosen) || there[0];
    if (followed) this.followTo(new THREE.Vector3(...followed.joints[0]));
    this.changed = true;
  }

  figureOf(number) {
    if (!this.figures.has(number)) {
      const color = this.hello.people > 1 ? this.hello.person_colors[number - 1] : null;
      this.figures.set(number, new Figure(this.scene, this.hello, color));
      this.dress();
    }
    return this.figures.get(number);
  }

  // To the side and in depth; up and down the person moves in the picture.
  followTo(place) {
    const before = this.target;
    this.target = place;
    if (!this.placed) {
      this.placed = true;
      this.followedAt = performance.now();
      this.home();
      return;
    }
    const now = performance.now();
    const share = 1 - Math.exp(-(now - this.followedAt) / (1000 * FOLLOW_S));
    this.followedAt = now;
    if (!this.follow) return;
    const way = place.clone().sub(this.orbit.target).setY(0);
    const jumps = before && before.distanceTo(place) > JUMP_M;
    if (!jumps) way.multiplyScalar(share);
    this.orbit.target.add(way);
    this.camera.position.add(way);
    this.orbit.update();
  }

  setShown(what, on) {
    this.shown[what] = on;
    if (this.cloud) this.cloud.points.visible = this.shown.cloud;
    for (const figure of this.figures.values()) {
      figure.skeleton.visible = this.shown.skeleton;
      figure.markers.visible = this.shown.markers;
      if (figure.body) figure.body.scene.visible = this.shown.surface;
    }
    this.dress();
    this.changed = true;
  }

  // The body is fetched when it is first wanted.
  async dress() {
    if (!this.shown.surface) return;
    if (!this.bodyBytes) {
      this.bodyBytes = fetch(withToken("/body.glb")).then((response) => response.arrayBuffer());
    }
    const bytes = await this.bodyBytes;
    for (const figure of this.figures.values()) figure.wear(bytes, () => { this.changed = true; });
  }

  // Whether a body is shown.
  wearsBody() {
    return [...this.figures.values()].some((figure) => figure.body !== null);
  }

  render() {
    if (!this.changed) return;
    this.changed = false;
    this.renderer.render(this.scene, this.camera);
  }
}
