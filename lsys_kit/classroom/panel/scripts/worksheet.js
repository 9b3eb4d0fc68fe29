// A table to fill as a widget of Jupyter.

import { askForEntries } from "./lessons/filling.js";

export default { render: askForEntries };
