import type { Lesson } from "../lesson.js";
import { bezier } from "./bezier.js";
import { box } from "./box.js";
import { capstone } from "./capstone.js";
import { chain } from "./chain.js";
import { cloth } from "./cloth.js";
import { compliance } from "./compliance.js";
import { determinism } from "./determinism.js";
import { integrators } from "./integrators.js";
import { iterations } from "./iterations.js";
import { point } from "./point.js";
import { ragdoll } from "./ragdoll.js";
import { rope } from "./rope.js";
import { split } from "./split.js";
import { stick } from "./stick.js";
import { substeps } from "./substeps.js";
import { swing } from "./swing.js";
import { tearing } from "./tearing.js";
import { triangle } from "./triangle.js";

/** THE list, in the order of reading. */
export const lessons: Lesson[] = [
    point, stick, split, integrators, triangle, box, iterations, substeps, chain, cloth, tearing, ragdoll, bezier, compliance, rope, swing, determinism, capstone,
];
