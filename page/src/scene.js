// Draws the geoms of a MuJoCo model in the view of its camera.
import * as THREE from "three";

const HIDDEN = 4; // The group of geoms that images do not show.
const SHAPES = {
  2: () => new THREE.SphereGeometry(1, 48, 32),
  3: ([radius, half]) => new THREE.CapsuleGeometry(radius, 2 * half, 12, 32).rotateX(Math.PI / 2),
  4: () => new THREE.SphereGeometry(1, 48, 32),
  5: () => new THREE.CylinderGeometry(1, 1, 2, 48).rotateX(Math.PI / 2),
  6: () => new THREE.BoxGeometry(2, 2, 2),
};
// What a shape is stretched by, along its axes, from its size.
const SCALES = { 2: ([r]) => [r, r, r], 3: () => [1, 1, 1], 4: (size) => size, 5: ([r, half]) => [r, r, half], 6: (size) => size };
const COLORS = { background: "#f3f1ec", floor: "#f3f1ec", mat: "#fbfaf7", band: "#8a5a2f", mark: "#8d867a" };

export class Scene {
  constructor(canvas) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.camera = new THREE.PerspectiveCamera(20, 1, 0.05, 30);
    this.camera.up.set(0, 0, 1);
  }

  // Lines, ends in pairs, are on the floor.
  build(model, structure, lines) {
    Object.assign(this, { model, structure });
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(COLORS.background);
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#d8d2c6", 2.0), this.sun());
    this.meshes = structure.geoms.map((name, geom) => this.mesh(geom));
    this.meshes.filter(Boolean).forEach((mesh) => this.scene.add(mesh));
    const marks = new THREE.BufferGeometry().setFromPoints(lines.map((place) => new THREE.Vector3(...place)));
    this.scene.add(new THREE.LineSegments(marks, new THREE.LineBasicMaterial({ color: COLORS.mark })));
    const [x, y, z] = model.cam_pos;
    const m = model.cam_mat0;
    const view = new THREE.Matrix4().set(m[0], m[1], m[2], x, m[3], m[4], m[5], y, m[6], m[7], m[8], z, 0, 0, 0, 1);
    view.decompose(this.camera.position, this.camera.quaternion, new THREE.Vector3());
    this.fov = model.cam_fovy[0];
    this.bands = [];
  }

  sun() {
    const sun = new THREE.DirectionalLight("#fff6e6", 2.2);
    sun.position.set(-1.2, -1.6, 3);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    Object.assign(sun.shadow.camera, { left: -1, right: 1, top: 1, bottom: -1, far: 8 });
    sun.shadow.bias = -0.002;
    return sun;
  }

  // Walls and the ground are never shown, and hidden things after the answer.
  mesh(geom) {
    const { model, structure } = this;
    const [ground, mat] = [geom === structure.floor[0], geom === structure.floor[1]];
    const isStaged = structure.staged.includes(geom);
    const isHidden = model.geom_group[geom] === HIDDEN && !isStaged;
    const kind = model.geom_type[geom];
    if (!(kind in SHAPES) || (isHidden && !structure.moving.includes(geom))) return null;
    const size = Array.from(model.geom_size.slice(3 * geom, 3 * geom + 3));
    const [r, g, b, opacity] = model.geom_rgba.slice(4 * geom, 4 * geom + 4);
    const color = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
    if (ground || mat) color.set(ground ? COLORS.floor : COLORS.mat);
    const material = new THREE.MeshStandardMaterial({ color, roughness: 0.62, transparent: opacity < 1, opacity });
    const mesh = new THREE.Mesh(SHAPES[kind](size), material);
    mesh.scale.set(...SCALES[kind](size));
    mesh.castShadow = !ground && !mat;
    mesh.receiveShadow = true;
    mesh.visible = isStaged || (!isHidden && structure.placed.includes(geom));
    mesh.userData = { geom, kind, isGround: ground || mat };
    return mesh;
  }

  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // A narrow picture shows as much from left to right as a square one.
    const half = Math.tan(THREE.MathUtils.degToRad(this.fov / 2)) / Math.min(1, this.camera.aspect);
    this.camera.fov = THREE.MathUtils.radToDeg(2 * Math.atan(half));
    this.camera.updateProjectionMatrix();
  }

  show({ positions, rotations, sizes }) {
    const turned = new THREE.Matrix4();
    this.meshes.forEach((mesh, geom) => {
      if (!mesh) return;
      const m = rotations.slice(9 * geom, 9 * geom + 9);
      turned.set(m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0, 0, 0, 0, 1);
      mesh.quaternion.setFromRotationMatrix(turned);
      mesh.position.fromArray(positions, 3 * geom);
      if (sizes[geom]) mesh.scale.set(...SCALES[mesh.userData.kind](sizes[geom]));
    });
    for (const { line, ends } of this.bands) line.geometry.setFromPoints(ends.map((mesh) => mesh.position));
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }

  dropShadows() {
    this.renderer.shadowMap.enabled = false;
    this.meshes.filter(Boolean).forEach((mesh) => (mesh.material.needsUpdate = true));
  }

  // Shows hidden things and bands; all that stands before a hidden thing turns to glass.
  reveal(tied) {
    const hidden = this.meshes.filter((mesh) => mesh && !mesh.visible);
    const shown = this.meshes.filter((mesh) => mesh?.visible && !mesh.userData.isGround);
    this.scene.updateMatrixWorld(true);
    for (const { position } of hidden) {
      const distance = position.distanceTo(this.camera.position);
      const ray = position.clone().sub(this.camera.position).normalize();
      for (const hit of new THREE.Raycaster(this.camera.position, ray, 0, distance).intersectObjects(shown)) {
        Object.assign(hit.object.material, { transparent: true, opacity: 0.25, depthWrite: false, needsUpdate: true });
        hit.object.castShadow = false;
      }
    }
    hidden.forEach((mesh) => (mesh.visible = true));
    for (const pair of tied) {
      const ends = pair.map((thing) => this.find(thing));
      const line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: COLORS.band }));
      line.material.depthTest = false;
      this.bands.push({ line, ends });
      this.scene.add(line);
    }
  }

  // The mesh of a thing, a drawn one if it has several.
  find(thing) {
    const own = this.meshes.filter((mesh) => mesh && this.structure.things[mesh.userData.geom] === thing);
    return own.find((mesh) => mesh.visible) ?? own[0];
  }

  // Where a place above a thing is in the picture, as shares of its width and height; null if the thing has no mesh.
  locate(thing, above = 0) {
    const mesh = this.find(thing);
    if (!mesh) return null;
    const place = mesh.position.clone();
    place.z += above * mesh.scale.z;
    return this.project(place);
  }

  project(place) {
    const { x, y } = new THREE.Vector3(...place).project(this.camera);
    return [(x + 1) / 2, (1 - y) / 2];
  }

  isBelow(thing) {
    const { position, scale } = this.find(thing);
    return position.z + scale.z <= 0;
  }

  // The thing at a place of the picture; null for none.
  pick(x, y) {
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(2 * x - 1, 1 - 2 * y), this.camera);
    const hit = caster.intersectObjects(this.meshes.filter((mesh) => mesh?.visible))[0];
    return hit ? this.structure.things[hit.object.userData.geom] : null;
  }
}
