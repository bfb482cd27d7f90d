// A sail in the wind beside a ball, in three.js: positions and triangles of the engine become a BufferGeometry. The mouse pulls at it.
import * as THREE from "three";
import { load } from "sinew";
import { Clock } from "./clock.js";

const engine = await load();
const simulation = engine.open({
    sinew: 1,
    dimension: 3,
    world: { gravity: [0, -9.81, 0], damping: 0.3, forces: [{ force: "wind", velocity: [0.3, 0, 1.5], density: 1.2, gust: [0.6, 0.2, 1.2], gust_period: 0.6, seed: 5 }] },
    colliders: [{ name: "ball", shape: "sphere", radius: 0.45, at: [0, 0.7, 0.5] }],
    figures: [{ prefab: "cloth", name: "sail", at: [0, 2, 0], columns: 32, rows: 26, spacing: 0.06, pins: "corners", mass: 1, drawn: "fill" }],
});

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.shadowMap.enabled = true;
document.body.append(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0xf5f3ee);
const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 50);
camera.position.set(2.2, 1.8, 4.2);
camera.lookAt(0, 1.1, 0);
const sun = new THREE.DirectionalLight(0xffffff, 2.5);
sun.position.set(2, 4, 3);
sun.castShadow = true;
scene.add(sun, new THREE.HemisphereLight(0xffffff, 0x998877, 1.2));

const ball = new THREE.Mesh(new THREE.SphereGeometry(0.44, 48, 32), new THREE.MeshStandardMaterial({ color: 0x3b5b7a }));
ball.position.set(0, 0.7, 0.5);
const floor = new THREE.Mesh(new THREE.PlaneGeometry(20, 20), new THREE.MeshStandardMaterial({ color: 0xe6e0d4 }));
floor.rotation.x = -Math.PI / 2;
ball.castShadow = ball.receiveShadow = floor.receiveShadow = true;
scene.add(ball, floor);

const geometry = new THREE.BufferGeometry();
geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(simulation.positions), 3));
geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(simulation.triangles), 1));
const cloth = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ color: 0xc8553d, side: THREE.DoubleSide, roughness: 0.8 }));
cloth.castShadow = true;
cloth.frustumCulled = false;
scene.add(cloth);

// The pointer takes the nearest corner of the triangle that it is on, and moves it in a plane that faces the camera.
const raycaster = new THREE.Raycaster(), plane = new THREE.Plane(), target = new THREE.Vector3();
/** @param {PointerEvent} event */
function aim({ clientX, clientY }) {
    raycaster.setFromCamera(new THREE.Vector2((clientX / innerWidth) * 2 - 1, 1 - (clientY / innerHeight) * 2), camera);
}
renderer.domElement.addEventListener("pointerdown", (event) => {
    aim(event);
    const [hit] = raycaster.intersectObject(cloth);
    if (!hit?.face) return;
    plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(new THREE.Vector3()), hit.point);
    simulation.grab(simulation.particle(hit.face.a));
    simulation.drag(hit.point.toArray());
});
addEventListener("pointermove", (event) => {
    aim(event);
    if (event.buttons && raycaster.ray.intersectPlane(plane, target)) simulation.drag(target.toArray());
});
addEventListener("pointerup", () => simulation.letGo());

function resize() {
    renderer.setPixelRatio(devicePixelRatio);
    renderer.setSize(innerWidth, innerHeight);
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
}
addEventListener("resize", resize);
resize();

const clock = new Clock();
let last = performance.now();
renderer.setAnimationLoop((now) => {
    clock.advance(simulation, (now - last) / 1000);
    last = now;
    geometry.attributes.position.array.set(simulation.positions); // a copy: doubles become floats
    geometry.attributes.position.needsUpdate = true;
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere();
    renderer.render(scene, camera);
});
