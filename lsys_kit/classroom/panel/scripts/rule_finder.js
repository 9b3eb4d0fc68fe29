// The rules that fit some words, as a widget of Jupyter.

import { showRules } from "./lessons/finding.js";

export default { render: showRules };
