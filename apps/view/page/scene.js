"use strict";

// The 3D scene: the tracker's world, metres, y up, the camera at the origin looking along -z.
const BONES = [
  ["pelvis", "spine"], ["spine", "neck"], ["neck", "head"],
  ["neck", "left_shoulder"], ["left_shoulder", "left_elbow"], ["left_elbow", "left_wrist"],
  ["neck", "right_shoulder"], ["right_shoulder", "right_elbow"], ["right_elbow", "right_wrist"],
  ["pelvis", "left_hip"], ["left_hip", "left_knee"], ["left_knee", "left_ankle"], ["left_ankle", "left_toe"],
  ["pelvis", "right_hip"], ["right_hip", "right_knee"], ["right_knee", "right_ankle"], ["right_ankle", "right_toe"]];
const JOINT_RADIUS = 0.022;
const BONE_RADIUS = 0.011;
const MARKER_RADIUS = 0.026;
// The first nodes of /body.glb are the bones that `rotations` of a frame turn, in this order.
const SKIN_BONES = 20;
const UP = new THREE.Vector3(0, 1, 0);

// Whether pictures are drawn without a graphics card, where smooth edges cost more than all else.
function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl && gl.getExtension("WEBGL_debug_renderer_info");
  return Boolean(info) && /swiftshader|llvmpipe|software/i.test(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
}

class Scene {
  constructor(parent, jointNames, partColors, bodyStature) {
    this.parent = parent;
    this.jointIndex = new Map(jointNames.map((name, i) => [name, i]));
    this.colors = partColors.map((c) => c.map((v) => v / 255));
    this.pointColors = partColors;
    this.bodyStature = bodyStature;
    this.renderer = new THREE.WebGLRenderer({ antialias: !drawsInSoftware() });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    parent.appendChild(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0x14171c);
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.05, 50);
    this.changed = true;  // since it was last drawn
    this.orbit = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.orbit.addEventListener("change", () => { this.changed = true; });
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x39404d, 0.85));
    const sun = new THREE.DirectionalLight(0xffffff, 0.55);
    sun.position.set(1, 3, 2);
    this.scene.add(sun);
    this.grid = new THREE.GridHelper(10, 20, 0x4a5362, 0x2e343e);
    this.grid.position.set(0, -1, -2.5);
    this.scene.add(this.grid);
    this.addFigure(jointNames);
    this.cloud = null;
    this.body = null;
    this.placed = false;
    this.resize();
    window.addEventListener("resize", () => this.resize());
    this.home();
  }

  addFigure(jointNames) {
    this.skeleton = new THREE.Group();
    this.joints = jointNames.map(() => {
      const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(JOINT_RADIUS, 16, 12),
        new THREE.MeshLambertMaterial({ color: 0xffffff }));
      this.skeleton.add(ball);
      return ball;
    });
    this.bones = BONES.map(([from]) => {
      const color = from.startsWith("left") ? 0x5ab0ff : from.startsWith("right") ? 0xff8a65 : 0xe8e8e8;
      const bone = new THREE.Mesh(new THREE.CylinderBufferGeometry(BONE_RADIUS, BONE_RADIUS, 1, 10),
        new THREE.MeshLambertMaterial({ color }));
      this.skeleton.add(bone);
      return bone;
    });
    this.scene.add(this.skeleton);
    this.markers = new THREE.Group();
    this.markerBalls = this.colors.slice(1).map((c) => {
      const ball = new THREE.Mesh(new THREE.OctahedronBufferGeometry(MARKER_RADIUS),
        new THREE.MeshLambertMaterial({ color: new THREE.Color(c[0], c[1], c[2]) }));
      this.markers.add(ball);
      return ball;
    });
    this.scene.add(this.markers);
  }

  home() {
    const z = this.target ? this.target.z : -2.5;
    this.orbit.target.set(this.target ? this.target.x : 0, this.target ? this.target.y : 0, z);
    this.camera.position.set(this.orbit.target.x + 0.5, this.orbit.target.y + 0.45, z + 2.9);
    this.orbit.update();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.parent;
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    this.renderer.setSize(width, height);
    this.changed = true;
  }

  // Pixels with a measurement as points; the actor's in the colours of their parts.
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
        const part = labels[i];
        if (part > 0 && part < this.colors.length) {
          colors.set(this.pointColors[part], 4 * n);
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
    points.visible = this.cloud ? this.cloud.points.visible : this.cloudVisible !== false;
    this.scene.add(points);
    this.cloud = { count, positions, colors, geometry, points };
  }

  showFigure(frame) {
    const there = frame.joints !== undefined;
    this.skeleton.visible = there && this.skeletonVisible !== false;
    if (this.body) this.body.scene.visible = there && this.surfaceVisible === true;
    this.grid.position.y = frame.floor_y;
    if (!there) return;
    const places = frame.joints.map((p) => new THREE.Vector3(p[0], p[1], p[2]));
    this.target = places[0];
    if (!this.placed) {
      this.placed = true;
      this.home();
    }
    places.forEach((p, j) => {
      this.joints[j].position.copy(p);
      const c = frame.confidence[j];
      this.joints[j].material.color.setRGB(1 - 0.7 * c, 0.35 + 0.6 * c, 0.35);
    });
    BONES.forEach(([from, to], b) => {
      const a = places[this.jointIndex.get(from)];
      const along = places[this.jointIndex.get(to)].clone().sub(a);
      const length = along.length();
      this.bones[b].position.copy(a).addScaledVector(along, 0.5);
      this.bones[b].scale.set(1, length, 1);
      this.bones[b].quaternion.setFromUnitVectors(UP, along.divideScalar(Math.max(length, 1e-6)));
    });
    this.poseBody(frame);
  }

  showMarkers(markers) {
    this.markerBalls.forEach((ball) => { ball.visible = false; });
    for (const [part, x, y, z, confidence] of markers) {
      const ball = this.markerBalls[part - 1];
      ball.visible = true;
      ball.position.set(x, y, z);
      ball.scale.setScalar(0.5 + 0.8 * confidence);
    }
  }

  // The body is fetched when it is first wanted.
  setSurfaceVisible(visible, url) {
    this.surfaceVisible = visible;
    if (this.body) this.body.scene.visible = visible;
    if (!visible || this.body || this.loading) return;
    this.loading = true;
    new THREE.GLTFLoader().load(url, (gltf) => {
      const bones = [];
      gltf.scene.traverse((node) => {
        if (!node.isSkinnedMesh) return;
        node.frustumCulled = false;
        node.material.transparent = true;
        node.material.opacity = 0.8;
        bones.push(...node.skeleton.bones.slice(0, SKIN_BONES));
      });
      this.body = { scene: gltf.scene, bones };
      this.scene.add(gltf.scene);
      if (this.lastPose) this.poseBody(this.lastPose);
      this.changed = true;
    });
  }

  poseBody(frame) {
    this.lastPose = frame;
    if (!this.body) return;
    const { bones } = this.body;
    frame.rotations.forEach((r, b) => bones[b].quaternion.set(r[0], r[1], r[2], r[3]));
    bones[0].position.set(frame.root[0], frame.root[1], frame.root[2]);
    bones[0].scale.setScalar(frame.stature_m / this.bodyStature);
  }

  render() {
    if (!this.changed) return;
    this.changed = false;
    this.renderer.render(this.scene, this.camera);
  }
}
