"use strict";

// One person in the 3D scene: joints, bones, markers, and the body's surface where it is wanted.
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

class Figure {
  // `color`: [r, g, b] of this person where there are several; null: left and right are told apart, markers by part.
  constructor(parent, hello, color) {
    this.hello = hello;
    this.color = color;
    this.jointIndex = new Map(hello.joints.map((name, i) => [name, i]));
    this.group = new THREE.Group();
    this.skeleton = new THREE.Group();
    this.markers = new THREE.Group();
    this.group.add(this.skeleton, this.markers);
    parent.add(this.group);
    const add = (group, geometry, material) => {
      const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: material }));
      group.add(mesh);
      return mesh;
    };
    const ball = new THREE.SphereBufferGeometry(JOINT_RADIUS, 16, 12);
    this.joints = hello.joints.map(() => add(this.skeleton, ball, 0xffffff));
    const stick = new THREE.CylinderBufferGeometry(BONE_RADIUS, BONE_RADIUS, 1, 10);
    this.bones = BONES.map(([from]) => add(this.skeleton, stick, this.boneColor(from)));
    const marker = new THREE.OctahedronBufferGeometry(MARKER_RADIUS);
    this.markerBalls = hello.part_colors.slice(1).map((c) => add(this.markers, marker, cssColor(color || c)));
    this.body = null;
  }

  boneColor(from) {
    if (this.color) return cssColor(this.color);
    if (from.startsWith("left")) return 0x5ab0ff;
    return from.startsWith("right") ? 0xff8a65 : 0xe8e8e8;
  }

  // `person`: an entry of a frame's `people`, or the frame itself; `shown`: which parts of the figure are wanted.
  show(person, shown) {
    const there = person.joints !== undefined;
    this.group.visible = true;
    this.skeleton.visible = there && shown.skeleton;
    this.markers.visible = shown.markers;
    if (this.body) this.body.scene.visible = there && shown.surface;
    this.showMarkers(person.markers);
    if (!there) return;
    const places = person.joints.map((p) => new THREE.Vector3(p[0], p[1], p[2]));
    places.forEach((p, j) => {
      const c = person.confidence[j];
      this.joints[j].position.copy(p);
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
    this.poseBody(person);
  }

  hide() { this.group.visible = false; }

  showMarkers(markers) {
    this.markerBalls.forEach((ball) => { ball.visible = false; });
    for (const [part, x, y, z, confidence] of markers) {
      const ball = this.markerBalls[part - 1];
      ball.visible = true;
      ball.position.set(x, y, z);
      ball.scale.setScalar(0.5 + 0.8 * confidence);
    }
  }

  // `bytes`: of /body.glb.
  wear(bytes, done) {
    if (this.body || this.loading) return;
    this.loading = true;
    new THREE.GLTFLoader().parse(bytes, "", (gltf) => {
      const bones = [];
      gltf.scene.traverse((node) => {
        if (!node.isSkinnedMesh) return;
        node.frustumCulled = false;
        node.material.transparent = true;
        node.material.opacity = 0.8;
        if (this.color) node.material.color.set(cssColor(this.color));
        bones.push(...node.skeleton.bones.slice(0, SKIN_BONES));
      });
      this.body = { scene: gltf.scene, bones };
      this.group.add(gltf.scene);
      if (this.lastPose) this.poseBody(this.lastPose);
      done();
    });
  }

  poseBody(person) {
    this.lastPose = person;
    if (!this.body) return;
    const { bones } = this.body;
    person.rotations.forEach((r, b) => bones[b].quaternion.set(r[0], r[1], r[2], r[3]));
    bones[0].position.set(person.root[0], person.root[1], person.root[2]);
    bones[0].scale.setScalar(person.stature_m / this.hello.body_stature_m);
  }

  remove() { this.group.parent.remove(this.group); }
}
