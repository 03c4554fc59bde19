// Certificates of assemblies: a script of its own, as most machines have closed forms only.
import { Branch } from "./branch";

Object.assign(globalThis, { Branch });
